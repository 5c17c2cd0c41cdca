// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "waylode/structure/structure_adjuster.hpp"
#include "waylode/structure/testing/route_walks.hpp"

namespace waylode::structure {
namespace {

using core::Vector2;
using testing::exact_walk;
using testing::noisy_walk;
using testing::Stop;
using testing::Walker;

/// A way of right angles and others whose stretches are 6 to 25 m long.
std::vector<Stop> random_way(core::Rng& rng, std::size_t segments) {
  std::vector<Stop> stops{{Vector2::Zero(), "L0"}};
  double direction_rad = 0.0;
  for (std::size_t i = 0; i < segments; ++i) {
    const double length_m = rng.uniform(6.0, 25.0);
    const Vector2 way_m = length_m * Vector2(std::cos(direction_rad), std::sin(direction_rad));
    stops.push_back(
        {stops.back().position_m + way_m, std::string("L").append(std::to_string(i + 1))});
    direction_rad +=
        rng.below(3) == 0 ? rng.uniform(-1.2, 1.2) : (rng.below(2) == 0 ? 0.5 : -0.5) * core::kPi;
  }
  return stops;
}

double known_m(const std::vector<Stop>& stops) {
  return (stops[1].position_m - stops[0].position_m).norm();
}

Survey random_survey(core::Rng& rng) {
  const std::vector<Stop> way = random_way(rng, 2 + rng.below(3));
  Survey survey{{}, {{"L0", "L1", known_m(way), 0.01}}, {}};
  const std::size_t walks = 1 + rng.below(3);
  for (std::size_t i = 0; i < walks; ++i) {
    const Walker walker{rng.uniform(-3.0, 3.0), rng.normal(0.98, 0.03), 0.02, 0.03};
    survey.walks.push_back(noisy_walk(way, walker, rng));
  }
  return survey;
}

double largest_gap_m(const AdjustedStructure& a, const AdjustedStructure& b, double scale = 1.0) {
  double gap_m = 0.0;
  for (std::size_t i = 0; i < a.nodes.size(); ++i) {
    gap_m = std::max(gap_m, (scale * a.nodes[i].position_m - b.nodes[i].position_m).norm());
  }
  return gap_m;
}

RC_GTEST_PROP(StructureAdjusterProperties, RecoversExactWalks, (std::uint64_t seed)) {
  core::Rng rng(seed);
  const std::vector<Stop> way = random_way(rng, 2 + rng.below(4));
  Survey survey{{}, {{"L0", "L1", known_m(way), 0.01}}, {}};
  const std::size_t walks = 1 + rng.below(4);
  for (std::size_t i = 0; i < walks; ++i) {
    survey.walks.push_back(exact_walk(way, {.offset_rad = rng.uniform(-9.0, 9.0)}));
  }
  StructureAdjuster::Options options;
  options.corner_sigma_rad = 0.0;  // An angle of 85 degrees is to stay one.
  options.parallel_sigma_rad = 0.0;
  options.find_closures = false;  // Ways may cross.
  const auto structure = StructureAdjuster(options).adjust(survey);
  RC_ASSERT(structure.has_value());
  RC_ASSERT(structure->nodes.size() == way.size());
  for (std::size_t i = 0; i < way.size(); ++i) {
    RC_ASSERT((structure->nodes[i].position_m - way[i].position_m).norm() < 1e-5);
  }
}

RC_GTEST_PROP(StructureAdjusterProperties, DoesNotDependOnWhichWayAWalkerFaces,
              (std::uint64_t seed)) {
  core::Rng rng(seed);
  const Survey survey = random_survey(rng);
  Survey turned = survey;
  for (Walk& walk : turned.walks) {
    const double turn_rad = rng.uniform(-9.0, 9.0);
    for (WalkedSegment& segment : walk.segments) segment.direction_rad += turn_rad;
  }
  const StructureAdjuster adjuster({});
  const auto plain = adjuster.adjust(survey);
  const auto other = adjuster.adjust(turned);
  RC_ASSERT(plain.has_value() && other.has_value());
  RC_ASSERT(plain->nodes.size() == other->nodes.size());
  RC_ASSERT(largest_gap_m(*plain, *other) < 1e-3);
}

RC_GTEST_PROP(StructureAdjusterProperties, FollowsTheKnownDistanceInScale, (std::uint64_t seed)) {
  // Everything measured, known or allowed for in metres is larger by one factor.
  core::Rng rng(seed);
  Survey survey = random_survey(rng);
  StructureAdjuster::Options options;
  options.find_closures = false;
  const auto plain = StructureAdjuster(options).adjust(survey);
  const double factor = rng.uniform(0.5, 2.0);
  for (Walk& walk : survey.walks) {
    for (WalkedSegment& segment : walk.segments) {
      segment.length_m *= factor;
      segment.length_sigma_m *= factor;
    }
  }
  survey.known_distances[0].metres *= factor;
  survey.known_distances[0].sigma_m *= factor;
  options.landmark_sigma_m *= factor;
  const auto scaled = StructureAdjuster(options).adjust(survey);
  RC_ASSERT(plain.has_value() && scaled.has_value());
  RC_ASSERT(plain->nodes.size() == scaled->nodes.size());
  RC_ASSERT(largest_gap_m(*plain, *scaled, factor) < 1e-3);
}

RC_GTEST_PROP(StructureAdjusterProperties, GivesTheSameTwice, (std::uint64_t seed)) {
  core::Rng rng(seed);
  const Survey survey = random_survey(rng);
  const StructureAdjuster adjuster({});
  RC_ASSERT(adjuster.adjust(survey).value() == adjuster.adjust(survey).value());
}

}  // namespace
}  // namespace waylode::structure
