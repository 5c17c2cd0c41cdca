// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/structure/detail/layout.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace waylode::structure::detail {
namespace {

using core::Vector2;
using Pose = Layout::Pose;

/// Two places nearer than this give no direction.
constexpr double kLeastBase_m = 1.0;
/// A place agrees with a pose when it is off by no more than this and this share of its distance.
constexpr double kAgreement_m = 1.0;
constexpr double kAgreement_ratio = 0.15;

struct Pair {
  Vector2 chain_m;
  Vector2 place_m;
};

struct Fit {
  std::size_t agreeing = 0;
  double squares_m2 = 0.0;
  Pose pose;

  bool better_than(const Fit& other) const {
    return agreeing != other.agreeing ? agreeing > other.agreeing : squares_m2 < other.squares_m2;
  }
};

double angle_of(const Vector2& way) { return std::atan2(way.y(), way.x()); }

/// The pose by two places, and how many agree with it. Nothing when the two do not agree.
std::optional<Fit> fit(const std::vector<Pair>& pairs, const Pair& a, const Pair& b) {
  const Vector2 chain_m = b.chain_m - a.chain_m;
  const Vector2 place_m = b.place_m - a.place_m;
  if (chain_m.norm() < kLeastBase_m || place_m.norm() < kLeastBase_m) return std::nullopt;
  if (std::abs(chain_m.norm() - place_m.norm()) >
      2.0 * kAgreement_m + kAgreement_ratio * chain_m.norm()) {
    return std::nullopt;
  }
  Fit found;
  found.pose.heading_offset_rad = angle_of(place_m) - angle_of(chain_m);
  found.pose.scale_ratio = place_m.norm() / chain_m.norm();
  const Vector2 middle_m = 0.5 * (a.chain_m + b.chain_m);
  found.pose.shift_m = 0.5 * (a.place_m + b.place_m) - found.pose * middle_m;
  for (const Pair& pair : pairs) {
    const double off_m = (found.pose * pair.chain_m - pair.place_m).norm();
    if (off_m > kAgreement_m + kAgreement_ratio * (pair.chain_m - middle_m).norm()) continue;
    ++found.agreeing;
    found.squares_m2 += off_m * off_m;
  }
  return found.agreeing >= 2 ? std::optional(found) : std::nullopt;
}

std::optional<Fit> best_fit(const std::vector<Vector2>& chain_m, const std::vector<std::size_t>& of,
                            const Layout& layout) {
  std::vector<Pair> pairs;
  for (std::size_t visit = 0; visit < chain_m.size(); ++visit) {
    if (const auto& place_m = layout.places_m[of[visit]]) {
      pairs.push_back({chain_m[visit], *place_m});
    }
  }
  std::optional<Fit> best;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (std::size_t j = i + 1; j < pairs.size(); ++j) {
      const auto found = fit(pairs, pairs[i], pairs[j]);
      if (found && (!best || found->better_than(*best))) best = found;
    }
  }
  return best;
}

void put(std::size_t walk, const Pose& pose, const std::vector<Vector2>& chain_m,
         const Places& places, Layout& layout) {
  layout.walks[walk] = pose;
  for (std::size_t visit = 0; visit < chain_m.size(); ++visit) {
    auto& place_m = layout.places_m[places.of[walk][visit]];
    if (!place_m) place_m = pose * chain_m[visit];
  }
}

}  // namespace

std::vector<Vector2> chain_of(const Walk& walk) {
  std::vector<Vector2> chain_m;
  if (walk.segments.empty()) return chain_m;
  chain_m.emplace_back(Vector2::Zero());
  for (const WalkedSegment& segment : walk.segments) {
    chain_m.emplace_back(chain_m.back() +
                         segment.length_m * Vector2(std::cos(segment.direction_rad),
                                                    std::sin(segment.direction_rad)));
  }
  return chain_m;
}

std::size_t Layout::reached() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(walks, [](const auto& pose) { return pose.has_value(); }));
}

Layout lay_out(std::span<const Walk> walks, const Places& places, std::size_t base) {
  std::vector<std::vector<Vector2>> chains_m;
  for (const Walk& walk : walks) chains_m.push_back(chain_of(walk));
  Layout layout{std::vector<std::optional<Pose>>(walks.size()),
                std::vector<std::optional<Vector2>>(places.count())};
  put(base, {}, chains_m[base], places, layout);
  while (true) {
    std::optional<Fit> best;
    std::size_t next = 0;
    for (std::size_t w = 0; w < walks.size(); ++w) {
      if (layout.walks[w]) continue;
      const auto found = best_fit(chains_m[w], places.of[w], layout);
      if (!found || (best && !found->better_than(*best))) continue;
      best = found;
      next = w;
    }
    if (!best) return layout;
    put(next, best->pose, chains_m[next], places, layout);
  }
}

}  // namespace waylode::structure::detail
