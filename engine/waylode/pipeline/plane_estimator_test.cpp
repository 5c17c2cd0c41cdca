// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pipeline/plane_estimator.hpp"

#include <gtest/gtest.h>

#include "waylode/pipeline/testing/tiny_site.hpp"

namespace waylode::pipeline {
namespace {

using core::FloorId;
using core::Matrix2;
using core::Vector2;
using fusion::testing::heard;
using fusion::testing::step_of;
using testing::at_s;
using testing::model_of;
using testing::started_at;
using testing::tiny_model;
using testing::turned_site;

Matrix2 diagonal_m2(double x_m2, double y_m2) {
  return core::Vector2(x_m2, y_m2).asDiagonal().toDenseMatrix();
}

/// Keeps what it is told, in the site frame, and answers what it is given.
class Recorder final : public PlaneEstimator {
 public:
  Recorder(const Model& model, const SessionOptions& options) : PlaneEstimator(model, options) {
    begin();
  }

  std::vector<fusion::PlanarEstimate> starts;
  std::vector<observation::MotionDelta> steps;
  std::vector<fusion::PlanarMeasurement> scans;
  std::vector<fusion::PlanarEstimate> fields;
  std::optional<fusion::PlanarEstimate> answer;
  Vector2 near_asked_m = Vector2(6.0, 3.0);
  std::optional<fusion::CircleMatch> near_found;
  std::vector<Vector2> alternatives_found;

 private:
  void start(const fusion::PlanarEstimate& place) override { starts.push_back(place); }
  void step(const observation::MotionDelta& motion) override { steps.push_back(motion); }
  void hear(const fusion::PlanarMeasurement& whole_map, const Again& again) override {
    scans.push_back(whole_map);
    near_found = again.near(near_asked_m);
    alternatives_found = again.alternatives(3, 2.5);
  }
  void feel(const fusion::PlanarEstimate& place) override { fields.push_back(place); }
  std::optional<fusion::PlanarEstimate> place_at(core::DeviceTime time) const override {
    std::optional<fusion::PlanarEstimate> place = answer;
    if (place) place->time = time;
    return place;
  }
};

/// Answers with one place and keeps what it was asked, in floor frames.
class OnePlace final : public HeardAgain {
 public:
  std::optional<observation::RadioObservation> near(const core::Belief& around) const override {
    asked = around;
    return found;
  }
  std::vector<Vector2> alternatives(FloorId floor, std::size_t count,
                                    double apart_m) const override {
    EXPECT_EQ(count, 3U);
    EXPECT_EQ(apart_m, 2.5);
    return floor.index == 1 ? std::vector{Vector2(3.0, 4.0), Vector2(30.0, 1.0)}
                            : std::vector<Vector2>();
  }

  std::optional<observation::RadioObservation> found;
  mutable core::Belief asked;
};

TEST(PlaneEstimator, KnowsNothingBeforeTheFirstScan) {
  const auto model = tiny_model();
  Recorder plane(*model, {});
  plane.answer = fusion::PlanarEstimate();
  plane.add(step_of(0.0, 0.5, 0.7, 0.0));
  EXPECT_TRUE(plane.steps.empty());
  EXPECT_TRUE(plane.starts.empty());
  EXPECT_EQ(plane.belief_at(at_s(1.0)), std::nullopt);
}

TEST(PlaneEstimator, HasNoBeliefWithoutAPlace) {
  const auto model = tiny_model();
  Recorder plane(*model, {.known_floor = FloorId{1}, .start = {}});
  EXPECT_EQ(plane.belief_at(at_s(1.0)), std::nullopt);
}

TEST(PlaneEstimator, TellsScansStepsAndFieldsInTheSiteFrame) {
  const auto model = model_of(turned_site());
  Recorder plane(*model, {.known_floor = FloorId{1}, .start = {}});
  auto scan = heard(2.0, {{1, 0.0, {3.0, 4.0}}}, 0.8, 0.4);
  scan.floors[0].covariance_m2 = diagonal_m2(4.0, 9.0);
  plane.add(scan, OnePlace());
  plane.add(step_of(2.0, 2.5, 0.7, 0.2));
  plane.add(observation::MagneticObservation{at_s(2.5), FloorId{1}, Vector2(5.0, 1.0),
                                             diagonal_m2(1.0, 2.0), 0.5});
  // Turned by +90 degrees, (3, 4) is (-4, 3); then 10 m along x.
  ASSERT_EQ(plane.scans.size(), 1U);
  EXPECT_LT((plane.scans[0].position_m - Vector2(6.0, 3.0)).norm(), 1e-12);
  EXPECT_LT((plane.scans[0].covariance_m2 - diagonal_m2(9.0, 4.0)).norm(), 1e-12);
  EXPECT_EQ(plane.scans[0].measured, at_s(1.6));
  EXPECT_EQ(plane.scans[0].delivered, at_s(2.0));
  ASSERT_EQ(plane.steps.size(), 1U);
  EXPECT_NEAR(plane.steps[0].heading_rad, 0.5, 1e-12);
  EXPECT_EQ(plane.steps[0].length_m, 0.7);
  ASSERT_EQ(plane.fields.size(), 1U);
  EXPECT_LT((plane.fields[0].position_m - Vector2(9.0, 5.0)).norm(), 1e-12);
  EXPECT_LT((plane.fields[0].covariance_m2 - diagonal_m2(2.0, 1.0)).norm(), 1e-12);
}

TEST(PlaneEstimator, AnswersInTheFloorFrame) {
  const auto model = model_of(turned_site());
  Recorder plane(*model, {.known_floor = FloorId{1}, .start = {}});
  plane.answer = fusion::PlanarEstimate{at_s(0.0), Vector2(6.0, 3.0), diagonal_m2(9.0, 4.0)};
  const auto belief = plane.belief_at(at_s(3.0));
  ASSERT_TRUE(belief);
  EXPECT_EQ(belief->floor, FloorId{1});
  EXPECT_EQ(belief->floor_probability, 1.0);
  EXPECT_LT((belief->position_m - Vector2(3.0, 4.0)).norm(), 1e-12);
  EXPECT_LT((belief->covariance_m2 - diagonal_m2(4.0, 9.0)).norm(), 1e-12);
}

TEST(PlaneEstimator, MatchesAgainInTheFloorFrame) {
  const auto model = model_of(turned_site());
  Recorder plane(*model, {.known_floor = FloorId{1}, .start = {}});
  OnePlace again;
  again.found = heard(2.0, {{1, -3.5, {5.0, 1.0}}});
  plane.add(heard(2.0, {{1, 0.0, {3.0, 4.0}}}), again);
  // Asked near (6, 3) of the site, which is (3, 4) on the floor.
  EXPECT_EQ(again.asked.floor, FloorId{1});
  EXPECT_LT((again.asked.position_m - Vector2(3.0, 4.0)).norm(), 1e-12);
  ASSERT_TRUE(plane.near_found);
  EXPECT_LT((plane.near_found->position.position_m - Vector2(9.0, 5.0)).norm(), 1e-12);
  EXPECT_EQ(plane.near_found->log_likelihood, -3.5);
  ASSERT_EQ(plane.alternatives_found.size(), 2U);
  EXPECT_LT((plane.alternatives_found[0] - Vector2(6.0, 3.0)).norm(), 1e-12);
  EXPECT_LT((plane.alternatives_found[1] - Vector2(9.0, 30.0)).norm(), 1e-12);

  again.found = heard(3.0, {{0, -3.5, {5.0, 1.0}}});  // Another floor is no answer.
  plane.add(heard(3.0, {{1, 0.0, {3.0, 4.0}}}), again);
  EXPECT_FALSE(plane.near_found);
}

TEST(PlaneEstimator, TakesTheFloorByTheVotesOfAllScans) {
  const auto model = tiny_model();
  Recorder plane(*model, {});
  plane.answer = fusion::PlanarEstimate();
  for (int i = 0; i < 10; ++i) {
    plane.add(heard(1.0 * i, {{1, 0.0, {3.0, 4.0}}, {0, -3.0, {9.0, 9.0}}}), OnePlace());
  }
  plane.add(heard(10.0, {{0, 0.0, {9.0, 9.0}}, {1, -3.0, {5.0, 6.0}}}), OnePlace());
  EXPECT_EQ(plane.belief_at(at_s(10.0))->floor, FloorId{1});
  EXPECT_LT(plane.belief_at(at_s(10.0))->floor_probability, 1.0);
  ASSERT_EQ(plane.scans.size(), 11U);
  EXPECT_EQ(plane.scans.back().position_m, Vector2(5.0, 6.0));
  plane.add(heard(11.0, {{0, 0.0, {9.0, 9.0}}}), OnePlace());  // Says nothing about floor 1.
  EXPECT_EQ(plane.scans.size(), 11U);
  for (int i = 12; i < 32; ++i) {
    plane.add(heard(1.0 * i, {{0, 0.0, {9.0, 9.0}}, {1, -3.0, {5.0, 6.0}}}), OnePlace());
  }
  EXPECT_EQ(plane.belief_at(at_s(32.0))->floor, FloorId{0});
  EXPECT_EQ(plane.scans.back().position_m, Vector2(9.0, 9.0));
}

TEST(PlaneEstimator, KeepsToTheFloorItWasTold) {
  const auto model = tiny_model();
  Recorder plane(*model, {.known_floor = FloorId{1}, .start = {}});
  plane.answer = fusion::PlanarEstimate();
  plane.add(heard(1.0, {{0, 0.0, {3.0, 4.0}}}), OnePlace());
  EXPECT_TRUE(plane.scans.empty());
  plane.add(heard(2.0, {{0, 0.0, {3.0, 4.0}}, {1, -9.0, {7.0, 8.0}}}), OnePlace());
  ASSERT_EQ(plane.scans.size(), 1U);
  EXPECT_EQ(plane.scans[0].position_m, Vector2(7.0, 8.0));
  EXPECT_EQ(plane.belief_at(at_s(2.0))->floor, FloorId{1});
  EXPECT_EQ(plane.belief_at(at_s(2.0))->floor_probability, 1.0);
}

TEST(PlaneEstimator, IsToldItsStartInTheSiteFrameAndBelievesItsFloor) {
  const auto model = model_of(turned_site());
  SessionOptions options = started_at({3.0, 4.0});
  options.start->floor = FloorId{1};
  options.start->time = at_s(5.0);
  options.start->sigma_m = 2.0;
  Recorder plane(*model, options);
  ASSERT_EQ(plane.starts.size(), 1U);
  EXPECT_EQ(plane.starts[0].time, at_s(5.0));
  EXPECT_LT((plane.starts[0].position_m - Vector2(6.0, 3.0)).norm(), 1e-12);
  EXPECT_LT((plane.starts[0].covariance_m2 - diagonal_m2(4.0, 4.0)).norm(), 1e-12);
  plane.add(step_of(4.5, 5.0, 0.7, 0.0));  // Led to the start.
  plane.add(step_of(5.0, 5.5, 0.8, 0.0));
  ASSERT_EQ(plane.steps.size(), 1U);
  EXPECT_EQ(plane.steps[0].length_m, 0.8);
  for (int i = 6; i < 20; ++i) plane.add(heard(1.0 * i, {{0, 0.0, {9.0, 9.0}}}), OnePlace());
  EXPECT_TRUE(plane.scans.empty());
  plane.answer = fusion::PlanarEstimate();
  EXPECT_EQ(plane.belief_at(at_s(20.0))->floor, FloorId{1});
}

TEST(PlaneEstimator, PassesOverTheFieldOfAnotherFloor) {
  const auto model = tiny_model();
  Recorder plane(*model, {.known_floor = FloorId{1}, .start = {}});
  plane.add(observation::MagneticObservation{at_s(1.0), FloorId{0}, {1.0, 2.0}, {}, 0.0});
  EXPECT_TRUE(plane.fields.empty());
}

TEST(PlaneEstimator, IsOutsideFromAnUnknownScanToTheNextKnownOne) {
  const auto model = tiny_model();
  Recorder plane(*model, {.known_floor = FloorId{0}, .start = {}});
  plane.answer = fusion::PlanarEstimate();
  const auto state_at = [&](double time_s) {
    return plane.state_at(at_s(time_s), *plane.belief_at(at_s(time_s)));
  };
  plane.add(heard(1.0, {{0, 0.0, {9.0, 9.0}}}), OnePlace());
  EXPECT_EQ(state_at(1.0), core::FixState::kOk);
  plane.hear_unknown(at_s(2.0));
  EXPECT_EQ(state_at(2.0), core::FixState::kOutside);
  plane.add(heard(3.0, {{0, 0.0, {9.0, 9.0}}}), OnePlace());
  EXPECT_EQ(state_at(3.0), core::FixState::kOk);
  EXPECT_EQ(state_at(3.0 + model->options().fused.state.lost_after_s + 1.0),
            core::FixState::kUnknown);
}

}  // namespace
}  // namespace waylode::pipeline
