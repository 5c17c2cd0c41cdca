// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include "waylode/core/angle.hpp"
#include "waylode/core/covariance.hpp"
#include "waylode/structure/detail/network.hpp"

namespace waylode::structure::detail {
namespace {

using core::Vector2;
using Options = StructureAdjuster::Options;

struct Way {
  Stretch stretch;
  double length_m = 0.0;
  double direction_rad = 0.0;
};

Vector2 between(const Network& network, std::size_t a, std::size_t b) {
  return network.graph.nodes_m[b] - network.graph.nodes_m[a];
}

double angle_of(const Vector2& way) { return std::atan2(way.y(), way.x()); }

/// The angle between two lines, 0 to a quarter turn.
double between_lines_rad(double a_rad, double b_rad) {
  const double angle_rad = std::abs(core::wrap_angle(a_rad - b_rad));
  return std::min(angle_rad, core::kPi - angle_rad);
}

/// Stretches long enough to have a direction, longest first.
std::vector<Way> ways_of(const Network& network, double least_m) {
  std::vector<Way> ways;
  for (const Stretch& stretch : stretches_of(network)) {
    const Vector2 way_m = between(network, stretch.from, stretch.to);
    if (way_m.norm() >= least_m) ways.push_back({stretch, way_m.norm(), angle_of(way_m)});
  }
  std::ranges::stable_sort(ways,
                           [](const Way& a, const Way& b) { return a.length_m > b.length_m; });
  return ways;
}

/// [Zhong2017] 4: segments correct each other's directions.
void add_parallels(Network& network, const Options& options) {
  std::vector<Way> ways = ways_of(network, options.regular_least_m);
  while (!ways.empty()) {
    const double axis_rad = ways.front().direction_rad;
    const auto others = std::ranges::stable_partition(ways, [&](const Way& way) {
      return between_lines_rad(way.direction_rad, axis_rad) <= options.regular_tolerance_rad;
    });
    const std::vector<Way> parallel(ways.begin(), others.begin());
    ways.erase(ways.begin(), others.begin());
    if (parallel.size() < 2) continue;
    for (const Way& way : parallel) {
      network.graph.axis_terms.push_back(
          {way.stretch.from, way.stretch.to, network.graph.axes_rad.size()});
    }
    network.graph.axes_rad.push_back(axis_rad);
  }
}

/// [Zhong2017] 4: corners correct each other.
void add_corners(Network& network, const Options& options) {
  std::set<std::tuple<std::size_t, std::size_t, std::size_t>> known;
  for (std::size_t w = 0; w < network.visit_nodes.size(); ++w) {
    for (std::size_t i = 2; i < network.visit_nodes[w].size(); ++i) {
      const auto& of = network.places.of[w];
      const std::size_t before = *network.place_nodes[of[i - 2]];
      const std::size_t at = *network.place_nodes[of[i - 1]];
      const std::size_t after = *network.place_nodes[of[i]];
      const Vector2 in_m = between(network, before, at);
      const Vector2 out_m = between(network, at, after);
      if (in_m.norm() < options.regular_least_m || out_m.norm() < options.regular_least_m) continue;
      const double turn_rad = std::abs(core::wrap_angle(angle_of(out_m) - angle_of(in_m)));
      if (std::abs(turn_rad - 0.5 * core::kPi) > options.regular_tolerance_rad) continue;
      const auto [one, other] = std::minmax(before, after);
      if (!known.insert({at, one, other}).second) continue;
      network.graph.corners.push_back({before, at, after});
    }
  }
}

/// A place as the search for closures sees it.
struct Candidate {
  std::size_t place = 0;
  std::size_t node = 0;
  Visit visit;  ///< The first.
  std::set<std::size_t> neighbours;
  std::vector<double> directions_rad;  ///< Of the stretches that meet there.
};

std::vector<Candidate> candidates_of(const Network& network) {
  std::vector<Candidate> candidates;
  std::set<std::size_t> seen;
  for (std::size_t w = 0; w < network.visit_nodes.size(); ++w) {
    for (std::size_t visit = 0; visit < network.visit_nodes[w].size(); ++visit) {
      const std::size_t place = network.places.of[w][visit];
      if (!seen.insert(place).second) continue;
      candidates.push_back({place, *network.place_nodes[place], {w, visit}, {}, {}});
    }
  }
  for (const Stretch& stretch : stretches_of(network)) {
    const double direction_rad = angle_of(between(network, stretch.from, stretch.to));
    for (Candidate& candidate : candidates) {
      if (candidate.node != stretch.from && candidate.node != stretch.to) continue;
      candidate.neighbours.insert(candidate.node == stretch.from ? stretch.to : stretch.from);
      candidate.directions_rad.push_back(direction_rad);
    }
  }
  return candidates;
}

/// Whether a corridor of one place runs along or square to one of the other.
bool consistent(const Candidate& a, const Candidate& b, double tolerance_rad) {
  return std::ranges::any_of(a.directions_rad, [&](double a_rad) {
    return std::ranges::any_of(b.directions_rad, [&](double b_rad) {
      const double angle_rad = between_lines_rad(a_rad, b_rad);
      return std::min(angle_rad, 0.5 * core::kPi - angle_rad) <= tolerance_rad;
    });
  });
}

/// The gap when two places may be one, infinity otherwise.
double gap_m(const Network& network, const Eigen::MatrixXd& covariance, const Candidate& a,
             const Candidate& b, const Options& options) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const std::string& name_a = network.places.names[a.place];
  const std::string& name_b = network.places.names[b.place];
  if (a.node == b.node || a.neighbours.contains(b.node)) return kNever;
  if (!name_a.empty() && !name_b.empty()) return kNever;
  const Vector2 gap = between(network, a.node, b.node);
  if (gap.norm() > options.closure_reach_m) return kNever;
  if (!consistent(a, b, options.route_turn_tolerance_rad)) return kNever;
  const core::Matrix2 allowed_m2 =
      gap_covariance(covariance, a.node, b.node) +
      options.closure_sigma_m * options.closure_sigma_m * core::Matrix2::Identity();
  const double gate = options.closure_gate_sigma * options.closure_gate_sigma;
  return core::squared_mahalanobis(gap, allowed_m2) <= gate ? gap.norm() : kNever;
}

}  // namespace

core::Matrix2 gap_covariance(const Eigen::MatrixXd& covariance, std::size_t a, std::size_t b) {
  const auto i = static_cast<Eigen::Index>(2 * a);
  const auto j = static_cast<Eigen::Index>(2 * b);
  return covariance.block<2, 2>(i, i) + covariance.block<2, 2>(j, j) -
         covariance.block<2, 2>(i, j) - covariance.block<2, 2>(j, i);
}

void add_regularities(Network& network, const Options& options) {
  if (options.corner_sigma_rad > 0.0) add_corners(network, options);
  if (options.parallel_sigma_rad > 0.0) add_parallels(network, options);
}

std::vector<Closure> find_closures(const Network& network, const Eigen::MatrixXd& covariance,
                                   const Options& options) {
  const std::vector<Candidate> all = candidates_of(network);
  std::vector<std::size_t> nearest(all.size());
  std::vector<double> gaps_m(all.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < all.size(); ++j) {
      const double gap = gap_m(network, covariance, all[i], all[j], options);
      if (gap >= gaps_m[i]) continue;
      gaps_m[i] = gap;
      nearest[i] = j;
    }
  }
  std::vector<Closure> closures;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::size_t j = nearest[i];
    if (!std::isfinite(gaps_m[i]) || j <= i || nearest[j] != i) continue;
    closures.push_back({all[i].visit, all[j].visit, "", gaps_m[i]});
  }
  return closures;
}

}  // namespace waylode::structure::detail
