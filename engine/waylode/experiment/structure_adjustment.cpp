// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/experiment/structure_adjustment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "waylode/core/angle.hpp"
#include "waylode/experiment/bootstrap.hpp"

namespace waylode::experiment {
namespace {

using core::Result;
using structure::Walk;
using structure::WalkedSegment;

/// A route as found: lengths and turns.
struct Found {
  std::vector<double> lengths_m;
  std::vector<double> turns_rad;
};

Found found_by(const Walk& walk) {
  Found found;
  for (std::size_t i = 0; i < walk.segments.size(); ++i) {
    found.lengths_m.push_back(walk.segments[i].length_m);
    if (i == 0) continue;
    found.turns_rad.push_back(
        core::wrap_angle(walk.segments[i].direction_rad - walk.segments[i - 1].direction_rad));
  }
  return found;
}

bool follows(const Walk& walk, const StructureRoute& route) {
  if (walk.segments.size() != route.lengths_m.size()) return false;
  const Found found = found_by(walk);
  for (std::size_t i = 0; i < found.turns_rad.size(); ++i) {
    const double off_rad =
        core::wrap_angle(found.turns_rad[i] - core::radians_from_degrees(route.turns_deg[i]));
    if (std::abs(off_rad) > 0.25 * core::kPi) return false;
  }
  return true;
}

std::string name_of(std::size_t visit) { return "stop " + std::to_string(visit); }

Walk named_by_order(Walk walk) {
  for (std::size_t i = 0; i < walk.segments.size(); ++i) {
    walk.segments[i].begin_landmark = name_of(i);
    walk.segments[i].end_landmark = name_of(i + 1);
  }
  return walk;
}

Found mean_of_walks(std::span<const Walk> walks) {
  Found mean;
  const std::size_t segments = walks.front().segments.size();
  for (std::size_t i = 0; i < segments; ++i) {
    std::vector<double> lengths_m;
    std::vector<double> turns_rad;
    for (const Walk& walk : walks) {
      const Found found = found_by(walk);
      lengths_m.push_back(found.lengths_m[i]);
      if (i > 0) turns_rad.push_back(found.turns_rad[i - 1]);
    }
    mean.lengths_m.push_back(mean_of(lengths_m));
    // Turns of one route lie within a quarter turn of each other and never cancel.
    if (i > 0) mean.turns_rad.push_back(core::circular_mean(turns_rad)->mean_rad);
  }
  return mean;
}

Found scaled(Found found, const StructureAdjustmentOptions& options) {
  const std::size_t known = options.known_segment;
  const double ratio = options.route.lengths_m[known] / found.lengths_m[known];
  for (double& length_m : found.lengths_m) length_m *= ratio;
  return found;
}

Result<Found> adjusted(std::span<const Walk> walks, const StructureAdjustmentOptions& options,
                       const structure::StructureAdjuster::Options& adjuster) {
  structure::Survey survey;
  for (const Walk& walk : walks) survey.walks.push_back(named_by_order(walk));
  const std::size_t known = options.known_segment;
  survey.known_distances.push_back(
      {name_of(known), name_of(known + 1), options.route.lengths_m[known], options.known_sigma_m});
  const auto structure = structure::StructureAdjuster(adjuster).adjust(survey);
  if (!structure) return tl::unexpected(structure.error());
  std::vector<core::Vector2> stops_m;
  for (std::size_t visit = 0; visit <= options.route.lengths_m.size(); ++visit) {
    const auto node =
        std::ranges::find(structure->nodes, name_of(visit), &structure::StructureNode::landmark);
    if (node == structure->nodes.end()) {
      return core::fail(core::ErrorCode::kInvalidArgument,
                        "walks contradict each other about a whole stop; check them");
    }
    stops_m.push_back(node->position_m);
  }
  Found found;
  double before_rad = 0.0;
  for (std::size_t i = 1; i < stops_m.size(); ++i) {
    const core::Vector2 way_m = stops_m[i] - stops_m[i - 1];
    const double direction_rad = std::atan2(way_m.y(), way_m.x());
    found.lengths_m.push_back(way_m.norm());
    if (i > 1) found.turns_rad.push_back(core::wrap_angle(direction_rad - before_rad));
    before_rad = direction_rad;
  }
  return found;
}

/// Errors of several results, each a unit of its own.
struct ErrorUnits {
  std::vector<Unit> lengths_pct;
  std::vector<Unit> unknown_lengths_pct;
  std::vector<Unit> corners_deg;

  void add(const Found& found, const StructureAdjustmentOptions& options) {
    Unit lengths;
    Unit unknown;
    Unit corners;
    for (std::size_t i = 0; i < found.lengths_m.size(); ++i) {
      const double truth_m = options.route.lengths_m[i];
      lengths.push_back(100.0 * std::abs(found.lengths_m[i] - truth_m) / truth_m);
      if (i != options.known_segment) unknown.push_back(lengths.back());
    }
    for (std::size_t i = 0; i < found.turns_rad.size(); ++i) {
      const double truth_rad = core::radians_from_degrees(options.route.turns_deg[i]);
      corners.push_back(
          core::degrees_from_radians(std::abs(core::wrap_angle(found.turns_rad[i] - truth_rad))));
    }
    lengths_pct.push_back(std::move(lengths));
    unknown_lengths_pct.push_back(std::move(unknown));
    corners_deg.push_back(std::move(corners));
  }

  RouteErrors errors() const {
    return {bootstrap(lengths_pct, mean_of), bootstrap(unknown_lengths_pct, mean_of),
            bootstrap(corners_deg, mean_of)};
  }
};

/// The first `count` of a shuffle.
std::vector<Walk> draw(std::span<const Walk> walks, std::size_t count, core::Rng& rng) {
  std::vector<std::size_t> order(walks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<Walk> drawn;
  for (std::size_t i = 0; i < count; ++i) {
    std::swap(order[i], order[i + rng.below(order.size() - i)]);
    drawn.push_back(walks[order[i]]);
  }
  return drawn;
}

Result<void> check(const StructureAdjustmentOptions& options, std::size_t walks) {
  const StructureRoute& route = options.route;
  const bool usable = route.lengths_m.size() >= 2 &&
                      route.turns_deg.size() + 1 == route.lengths_m.size() &&
                      options.known_segment < route.lengths_m.size() && options.draws >= 1 &&
                      options.walks_per_draw >= 1 &&
                      std::ranges::all_of(route.lengths_m, [](double m) { return m > 0.0; });
  if (!usable) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "need a route of two stretches or more, one of them known, and a draw",
                      "structure adjustment");
  }
  if (walks >= options.walks_per_draw) return {};
  return core::fail(core::ErrorCode::kInvalidArgument,
                    "only " + std::to_string(walks) + " walks follow the route; give more",
                    "structure adjustment");
}

Figure figure(const char* what, const char* unit, const char* paper, const Interval& ours,
              std::optional<double> limit = std::nullopt) {
  Figure result{"D-X3", what, unit, paper, ours, std::nullopt, ""};
  if (limit) result.bar = Bar{Bar::Sense::kAtMost, *limit};
  return result;
}

}  // namespace

std::vector<Walk> simulate_walks(const StructureRoute& route, const WalkStatistics& statistics,
                                 std::size_t count, core::Rng& rng) {
  // A corner is the difference of two directions; |error| of a Gaussian has mean sqrt(2/pi) sigma.
  const double direction_sigma_rad = core::radians_from_degrees(statistics.corner_mean_abs_deg) *
                                     std::sqrt(0.5 * core::kPi) / std::numbers::sqrt2;
  std::vector<Walk> walks(count);
  for (Walk& walk : walks) {
    const double ratio =
        1.0 + statistics.common_bias_ratio + rng.normal(0.0, statistics.person_sigma_ratio);
    double direction_rad = rng.uniform(-core::kPi, core::kPi);
    for (std::size_t i = 0; i < route.lengths_m.size(); ++i) {
      if (i > 0) direction_rad += core::radians_from_degrees(route.turns_deg[i - 1]);
      WalkedSegment segment;
      segment.begin = core::device_time_from_seconds(60.0 * static_cast<double>(i));
      segment.end = segment.begin + core::from_seconds(60.0);
      segment.length_sigma_m = statistics.segment_sigma_ratio * route.lengths_m[i];
      segment.length_m =
          std::abs(ratio * route.lengths_m[i] + rng.normal(0.0, segment.length_sigma_m));
      segment.direction_sigma_rad = direction_sigma_rad;
      segment.direction_rad =
          core::wrap_angle(direction_rad + rng.normal(0.0, direction_sigma_rad));
      walk.segments.push_back(segment);
    }
  }
  return walks;
}

Result<StructureAdjustmentStudy> study_structure_adjustment(
    std::span<const Walk> walks, const StructureAdjustmentOptions& options) {
  std::vector<Walk> pool;
  for (const Walk& walk : walks) {
    if (follows(walk, options.route)) pool.push_back(walk);
  }
  if (auto checked = check(options, pool.size()); !checked) return tl::unexpected(checked.error());
  structure::StructureAdjuster::Options evidence_only = options.adjuster;
  evidence_only.corner_sigma_rad = 0.0;
  evidence_only.parallel_sigma_rad = 0.0;

  ErrorUnits single;
  ErrorUnits mean;
  ErrorUnits scaled_mean;
  ErrorUnits evidence;
  ErrorUnits all;
  for (const Walk& walk : pool) single.add(found_by(walk), options);
  core::Rng rng(options.seed);
  for (std::size_t i = 0; i < options.draws; ++i) {
    const std::vector<Walk> drawn = draw(pool, options.walks_per_draw, rng);
    const Found plain = mean_of_walks(drawn);
    mean.add(plain, options);
    scaled_mean.add(scaled(plain, options), options);
    const auto by_evidence = adjusted(drawn, options, evidence_only);
    if (!by_evidence) return tl::unexpected(by_evidence.error());
    evidence.add(*by_evidence, options);
    const auto by_all = adjusted(drawn, options, options.adjuster);
    if (!by_all) return tl::unexpected(by_all.error());
    all.add(*by_all, options);
  }
  return StructureAdjustmentStudy{pool.size(),   walks.size() - pool.size(), single.errors(),
                                  mean.errors(), scaled_mean.errors(),       evidence.errors(),
                                  all.errors()};
}

Outcome structure_adjustment_outcome(const StructureAdjustmentStudy& study,
                                     const StructureAdjustmentOptions& options, std::string data) {
  Outcome outcome;
  outcome.paper = "zhong2017";
  outcome.title = "One floor's structure from many walks";
  outcome.data = std::move(data);
  outcome.figures = {
      figure("mean length error, one walk", "%", "4", study.single.length_pct),
      figure("mean length error, mean of the walks", "%", "", study.mean.length_pct),
      figure("mean length error, mean scaled to the known segment", "%", "",
             study.scaled_mean.length_pct),
      figure("mean length error, adjusted", "%", "2", study.adjusted.length_pct, 2.0),
      figure("mean length error, adjusted, segments not known", "%", "2",
             study.adjusted.unknown_length_pct, 2.0),
      figure("mean corner error, one walk", "deg", "", study.single.corner_deg),
      figure("mean corner error, mean of the walks", "deg", "", study.mean.corner_deg),
      figure("mean corner error, adjusted by evidence alone", "deg", "1.5 %",
             study.evidence.corner_deg, 1.4),
      figure("mean corner error, adjusted", "deg", "1.5 %", study.adjusted.corner_deg, 1.4)};
  outcome.figures.back().note =
      "Right angles are preferred and the route has only such: the figure by evidence alone is the "
      "fair one.";
  outcome.notes.push_back("draws of " + std::to_string(options.walks_per_draw) + " of " +
                          std::to_string(study.walks) +
                          " walks share walks, so their intervals are too narrow");
  outcome.notes.push_back("known: the length of segment " + std::to_string(options.known_segment));
  if (study.left_out > 0) {
    outcome.notes.push_back(std::to_string(study.left_out) +
                            " walks do not have the route's segments and turns and were left out");
  }
  return outcome;
}

}  // namespace waylode::experiment
