// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/structure/detail/places.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string_view>

#include "waylode/core/angle.hpp"

namespace waylode::structure::detail {
namespace {

using Options = StructureAdjuster::Options;

/// Scales of two walkers do not differ by more.
constexpr double kLargestScale_ratio = 1.5;

/// Sets of visits that are one place. Numbers its visits walk by walk.
class VisitSets {
 public:
  VisitSets(std::span<const Walk> walks, std::span<const Visit> apart) {
    for (const Walk& walk : walks) {
      begin_.push_back(parent_.size());
      for (std::size_t visit = 0; visit < walk.visit_count(); ++visit) {
        parent_.push_back(parent_.size());
        name_.push_back(walk.landmark_at(visit));
      }
    }
    apart_.resize(parent_.size());
    for (const Visit& visit : apart) {
      apart_[index(visit)] = true;
      name_[index(visit)].clear();  // It is not there, whatever it is called.
    }
  }

  void unite(const Visit& a, const Visit& b) {
    if (apart_[index(a)] || apart_[index(b)]) return;
    const auto [first, second] = std::minmax({root(index(a)), root(index(b))});
    if (!name_[first].empty() && !name_[second].empty() && name_[first] != name_[second]) return;
    if (name_[first].empty()) name_[first] = name_[second];
    parent_[second] = first;
  }

  /// The set's name: of any of its visits.
  const std::string& name(const Visit& visit) const { return name_[root(index(visit))]; }
  std::size_t root_of(const Visit& visit) const { return root(index(visit)); }
  bool is_apart(const Visit& visit) const { return apart_[index(visit)]; }

 private:
  std::size_t index(const Visit& visit) const { return begin_[visit.walk] + visit.visit; }
  std::size_t root(std::size_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }

  std::vector<std::size_t> begin_;
  std::vector<std::size_t> parent_;  ///< Roots are the first visits of their sets.
  std::vector<std::string> name_;
  std::vector<bool> apart_;
};

/// A stretch of a walk, between two of its visits.
struct Leg {
  std::size_t walk = 0;
  std::size_t first = 0;
  std::size_t last = 0;

  std::size_t size() const { return last - first; }
  Visit visit(std::size_t i, bool backwards) const {
    return {walk, backwards ? last - i : first + i};
  }
};

/// A leg as walked from either end.
std::vector<WalkedSegment> segments_of(std::span<const Walk> walks, const Leg& leg,
                                       bool backwards) {
  const auto& all = walks[leg.walk].segments;
  std::vector<WalkedSegment> segments(all.begin() + static_cast<std::ptrdiff_t>(leg.first),
                                      all.begin() + static_cast<std::ptrdiff_t>(leg.last));
  if (!backwards) return segments;
  std::ranges::reverse(segments);
  for (WalkedSegment& segment : segments) segment.direction_rad += core::kPi;
  return segments;
}

double turn_rad(const std::vector<WalkedSegment>& segments, std::size_t i) {
  return segments[i].direction_rad - segments[i - 1].direction_rad;
}

bool turns_agree(const std::vector<WalkedSegment>& a, const std::vector<WalkedSegment>& b,
                 double tolerance_rad) {
  for (std::size_t i = 1; i < a.size(); ++i) {
    if (std::abs(core::wrap_angle(turn_rad(a, i) - turn_rad(b, i))) > tolerance_rad) return false;
  }
  return true;
}

/// Equal up to one common scale, that of the middle ratio.
bool lengths_agree(const std::vector<WalkedSegment>& a, const std::vector<WalkedSegment>& b,
                   double tolerance_ratio) {
  std::vector<double> log_ratios;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!(a[i].length_m > 0.0) || !(b[i].length_m > 0.0)) return false;
    log_ratios.push_back(std::log(a[i].length_m / b[i].length_m));
  }
  auto sorted = log_ratios;
  std::ranges::sort(sorted);
  const double common = sorted[sorted.size() / 2];
  if (std::abs(common) > std::log(kLargestScale_ratio)) return false;
  return std::ranges::all_of(log_ratios, [&](double value) {
    return std::abs(value - common) <= std::log1p(tolerance_ratio);
  });
}

bool same_shape(std::span<const Walk> walks, const Leg& a, const Leg& b, bool backwards,
                const Options& options) {
  if (a.size() != b.size()) return false;
  const auto of_a = segments_of(walks, a, false);
  const auto of_b = segments_of(walks, b, backwards);
  return turns_agree(of_a, of_b, options.route_turn_tolerance_rad) &&
         lengths_agree(of_a, of_b, options.route_length_tolerance_ratio);
}

bool has_name(const VisitSets& sets, const Leg& leg, std::string_view name) {
  for (std::size_t visit = leg.first; visit <= leg.last; ++visit) {
    if (!sets.is_apart({leg.walk, visit}) && sets.name({leg.walk, visit}) == name) return true;
  }
  return false;
}

/// No name of one leg is missing at its counterpart but borne elsewhere in the other.
bool names_agree(const VisitSets& sets, const Leg& a, const Leg& b, bool backwards) {
  for (std::size_t i = 0; i <= a.size(); ++i) {
    const Visit of_a = a.visit(i, false);
    const Visit of_b = b.visit(i, backwards);
    if (sets.is_apart(of_a) || sets.is_apart(of_b)) continue;
    const std::string& name_a = sets.name(of_a);
    const std::string& name_b = sets.name(of_b);
    if (name_a == name_b) continue;
    if (!name_a.empty() && (!name_b.empty() || has_name(sets, b, name_a))) return false;
    if (!name_b.empty() && has_name(sets, a, name_b)) return false;
  }
  return true;
}

/// Joins the legs' visits if they are one route, walked the same way or back. Whether they are.
bool join(std::span<const Walk> walks, const Leg& a, const Leg& b, const Options& options,
          VisitSets& sets, std::vector<std::string>& notes) {
  const auto fits = [&](bool backwards) {
    return same_shape(walks, a, b, backwards, options) && names_agree(sets, a, b, backwards);
  };
  const bool forwards = fits(false);
  const bool backwards = fits(true);
  if (!forwards && !backwards) return false;
  const bool named = !sets.name(a.visit(0, false)).empty();
  if (forwards && backwards && !named) {
    notes.push_back("walk " + std::to_string(b.walk) + " fits the route of walk " +
                    std::to_string(a.walk) +
                    " both ways; taken as walked the same way: name a landmark on both");
  }
  for (std::size_t i = 0; i <= a.size(); ++i) {
    sets.unite(a.visit(i, false), b.visit(i, !forwards));
  }
  return true;
}

/// Each leg joins the first earlier one of another walk that it fits.
void join_all(std::span<const Walk> walks, std::span<const Leg> legs, const Options& options,
              VisitSets& sets, std::vector<std::string>& notes) {
  for (std::size_t i = 1; i < legs.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (join(walks, legs[j], legs[i], options, sets, notes)) break;
    }
  }
}

/// Stretches between one landmark and the next, by the pair of names.
std::map<std::pair<std::string, std::string>, std::vector<Leg>> named_legs(
    std::span<const Walk> walks) {
  std::map<std::pair<std::string, std::string>, std::vector<Leg>> legs;
  for (std::size_t w = 0; w < walks.size(); ++w) {
    std::size_t first = 0;
    for (std::size_t visit = 0; visit < walks[w].visit_count(); ++visit) {
      const std::string& name = walks[w].landmark_at(visit);
      if (name.empty()) continue;
      const std::string& from = walks[w].landmark_at(first);
      if (!from.empty() && visit > first + 1) {
        legs[std::minmax(from, name)].push_back({w, first, visit});
      }
      first = visit;
    }
  }
  return legs;
}

void join_routes(std::span<const Walk> walks, const Options& options, VisitSets& sets,
                 std::vector<std::string>& notes) {
  for (const auto& [names, legs] : named_legs(walks)) join_all(walks, legs, options, sets, notes);
  std::vector<Leg> whole;
  for (std::size_t w = 0; w < walks.size(); ++w) {
    const std::size_t size = walks[w].segments.size();
    if (size >= options.route_least_segments) whole.push_back({w, 0, size});
  }
  join_all(walks, whole, options, sets, notes);
}

void join_names(std::span<const Walk> walks, VisitSets& sets) {
  std::map<std::string_view, Visit> first;
  for (std::size_t w = 0; w < walks.size(); ++w) {
    for (std::size_t visit = 0; visit < walks[w].visit_count(); ++visit) {
      const std::string& name = walks[w].landmark_at(visit);
      if (name.empty() || sets.is_apart({w, visit})) continue;
      sets.unite(first.try_emplace(name, Visit{w, visit}).first->second, {w, visit});
    }
  }
}

void join_standing(std::span<const Walk> walks, double reach_m, VisitSets& sets) {
  for (std::size_t w = 0; w < walks.size(); ++w) {
    for (std::size_t i = 0; i < walks[w].segments.size(); ++i) {
      if (walks[w].segments[i].length_m <= reach_m) sets.unite({w, i}, {w, i + 1});
    }
  }
}

Places number(std::span<const Walk> walks, const VisitSets& sets) {
  Places places;
  std::map<std::size_t, std::size_t> place_of_root;
  places.of.resize(walks.size());
  for (std::size_t w = 0; w < walks.size(); ++w) {
    for (std::size_t visit = 0; visit < walks[w].visit_count(); ++visit) {
      const auto [entry, is_new] =
          place_of_root.try_emplace(sets.root_of({w, visit}), places.names.size());
      if (is_new) places.names.push_back(sets.name({w, visit}));
      places.of[w].push_back(entry->second);
    }
  }
  return places;
}

}  // namespace

Places associate(std::span<const Walk> walks, const Findings& findings, const Options& options) {
  VisitSets sets(walks, findings.apart);
  std::vector<std::string> notes;
  join_names(walks, sets);
  join_standing(walks, options.landmark_sigma_m, sets);
  if (options.match_routes) join_routes(walks, options, sets, notes);
  for (const auto& [a, b] : findings.together) sets.unite(a, b);
  Places places = number(walks, sets);
  places.notes = std::move(notes);
  return places;
}

}  // namespace waylode::structure::detail
