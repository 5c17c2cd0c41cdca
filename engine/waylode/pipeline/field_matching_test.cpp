// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pipeline/field_matching.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "waylode/pipeline/testing/tiny_site.hpp"

namespace waylode::pipeline {
namespace {

using core::FloorId;
using core::Vector2;
using core::Vector3;
using testing::at_s;

constexpr double kStep_s = 0.5;
constexpr double kStep_m = 0.6;

/// Believes what it is given and counts how often it is asked.
class Believer final : public Estimator {
 public:
  void add(const observation::MotionDelta&) override {}
  void add(const observation::RadioObservation&, const HeardAgain&) override {}
  void add(const observation::MagneticObservation&) override {}
  void hear_unknown(core::DeviceTime) override {}
  std::optional<core::Belief> belief_at(core::DeviceTime) const override {
    ++asked;
    return belief;
  }
  core::FixState state_at(core::DeviceTime, const core::Belief&) const override {
    return core::FixState::kOk;
  }

  std::optional<core::Belief> belief;
  mutable int asked = 0;
};

Options::FieldMatch match_options() {
  Options::FieldMatch options;
  options.interval_s = 1.0;
  options.grid = {.node_m = 0.25, .reach_m = 0.8, .kernel_m = 0.25};
  options.sequence.largest_turn_rad = 0.0;
  options.sequence.shortest_path_m = 2.0;
  return options;
}

FieldMatching matching_on(const std::shared_ptr<const site::Site>& site) {
  const Options::FieldMatch options = match_options();
  auto fields = std::make_shared<const std::vector<magnetic::FieldGrid>>(
      magnetic::field_grids(site->magnetic_map(), site->floors().size(), options.grid));
  return FieldMatching(site, std::move(fields), options);
}

/// Walks east on a floor from (8, 4), the phone telling its own headings; the level phone's field
/// points ahead of it. Returns what the last step found.
std::optional<observation::MagneticObservation> walk_east(
    FieldMatching& matching, FloorId floor, double phone_heading_rad, int steps,
    const Estimator& estimator, std::optional<Vector3> up = Vector3(0.0, 0.0, 1.0)) {
  std::optional<observation::MagneticObservation> last;
  for (int step = 0; step < steps; ++step) {
    for (int i = 1; i <= 10; ++i) {
      const double time_s = kStep_s * (step + 0.1 * i);
      const Vector2 place_m(8.0 + kStep_m * time_s / kStep_s, 4.0);
      const magnetic::LevelField field = testing::field_at(floor, place_m);
      const sample::MagnetometerSample sample{
          at_s(time_s), Vector3(0.0, field.horizontal_ut, field.vertical_ut), 3};
      std::optional<observation::MotionDelta> motion;
      if (i == 10) {
        motion = fusion::testing::step_of(kStep_s * step, kStep_s * (step + 1), kStep_m,
                                          phone_heading_rad);
      }
      last = matching.add(sample, motion, up, estimator);
    }
  }
  return last;
}

Believer believer_at(FloorId floor, const Vector2& place_m) {
  Believer believer;
  believer.belief = core::Belief{floor, 1.0, place_m, core::Matrix2::Identity()};
  return believer;
}

TEST(FieldMatching, FindsWhereTheFieldOfTheWayWasWalked) {
  auto matching = matching_on(testing::tiny_site(testing::Field::kSurveyed));
  const Believer believer = believer_at({0}, {15.9, 4.9});  // Truly at (15.8, 4).
  const auto found = walk_east(matching, {0}, 0.0, 13, believer);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->floor, FloorId{0});
  EXPECT_EQ(found->time, at_s(6.5));
  EXPECT_LT((found->position_m - Vector2(15.8, 4.0)).norm(), 0.4);
}

TEST(FieldMatching, TurnsThePathOntoTheAxesOfItsFloor) {
  // East on the floor is north on the site, where headings are 0.3 rad more than the phone's.
  const double phone_rad = 0.5 * std::acos(-1.0) - 0.3;
  const auto site = testing::turned_site();
  const Believer believer = believer_at({1}, {16.5, 3.5});
  auto matching = matching_on(site);
  const auto found = walk_east(matching, {1}, phone_rad, 13, believer);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->floor, FloorId{1});
  EXPECT_LT((found->position_m - Vector2(15.8, 4.0)).norm(), 0.4);
  // The control: a path that lies otherwise fits worse, wherever it is put.
  auto mistaken = matching_on(site);
  const auto elsewhere = walk_east(mistaken, {1}, 0.0, 13, believer);
  if (elsewhere) {
    EXPECT_GT(elsewhere->mean_square_difference_ut2, 3.0 * found->mean_square_difference_ut2);
  }
}

TEST(FieldMatching, AsksAtItsInterval) {
  auto matching = matching_on(testing::tiny_site(testing::Field::kSurveyed));
  const Believer believer = believer_at({0}, {10.0, 5.0});
  walk_east(matching, {0}, 0.0, 13, believer);
  EXPECT_EQ(believer.asked, 7);  // After 0.5 s, 1.5 s ... 6.5 s.
}

TEST(FieldMatching, AsksAtEveryStepUntilAPlaceIsBelieved) {
  auto matching = matching_on(testing::tiny_site(testing::Field::kSurveyed));
  const Believer unsure;
  EXPECT_EQ(walk_east(matching, {0}, 0.0, 13, unsure), std::nullopt);
  EXPECT_EQ(unsure.asked, 13);
}

TEST(FieldMatching, FindsNothingWithoutKnowingWhichWayIsUp) {
  auto matching = matching_on(testing::tiny_site(testing::Field::kSurveyed));
  const Believer believer = believer_at({0}, {15.0, 4.5});
  EXPECT_EQ(walk_east(matching, {0}, 0.0, 13, believer, std::nullopt), std::nullopt);
}

TEST(FieldMatching, FindsNothingOnAFloorWhoseFieldWasNotSurveyed) {
  site::SiteParts parts = testing::tiny_parts(testing::Field::kSurveyed);
  std::erase_if(parts.magnetic_map.points,
                [](const site::MagneticPoint& point) { return point.floor == 1; });
  auto matching = matching_on(std::make_shared<const site::Site>(std::move(parts)));
  const Believer believer = believer_at({1}, {15.8, 4.0});
  EXPECT_EQ(walk_east(matching, {1}, 0.0, 13, believer), std::nullopt);
}

}  // namespace
}  // namespace waylode::pipeline
