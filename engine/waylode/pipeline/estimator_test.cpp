// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pipeline/estimator.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "waylode/fusion/testing/particle_model.hpp"
#include "waylode/pipeline/testing/tiny_site.hpp"

namespace waylode::pipeline {
namespace {

using core::FloorId;
using core::Vector2;
using fusion::testing::heard;
using fusion::testing::step_of;
using testing::at_s;
using testing::tiny_model;
using testing::tiny_options;

std::unique_ptr<Estimator> make(const Model& model, const char* method,
                                const SessionOptions& options = {}) {
  return make_estimator(model, *find_method(method), options);
}

/// For estimators that match no scan twice.
class Nowhere final : public HeardAgain {
 public:
  std::optional<observation::RadioObservation> near(const core::Belief&) const override {
    return std::nullopt;
  }
  std::vector<core::Vector2> alternatives(FloorId, std::size_t, double) const override {
    return {};
  }
};
Nowhere nowhere() { return {}; }

void tell(Estimator& estimator, const observation::RadioObservation& scan) {
  estimator.add(scan, nowhere());
}
template <typename Tracker>
void tell(Tracker& tracker, const observation::RadioObservation& scan) {
  tracker.add(scan);
}

/// Steps east and scans that come 0.4 s late, one far off.
template <typename Tracker>
void walk(Tracker& tracker) {
  for (int i = 0; i < 40; ++i) {
    tracker.add(step_of(0.5 * i, 0.5 * (i + 1), 0.7, 0.02 * i));
    if (i % 5 != 4) continue;
    const double x_m = i == 19 ? 39.0 : 5.0 + 0.7 * i;
    tell(tracker, fusion::testing::with_rasters(heard(
                      0.5 * (i + 1), {{0, 0.0, {x_m, 4.0}}, {1, -2.0, {x_m, 6.0}}}, 0.8, 0.4)));
  }
}

TEST(WknnMethod, BelievesTheNewestScanAlone) {
  const auto model = tiny_model();
  const auto wknn = make(*model, "wknn");
  EXPECT_EQ(wknn->belief_at(at_s(0.0)), std::nullopt);
  wknn->add(heard(1.0, {{0, 0.0, {3.0, 4.0}}}), nowhere());
  wknn->add(step_of(1.0, 1.5, 0.7, 0.0));
  wknn->add(heard(2.0, {{0, 0.0, {30.0, 5.0}}}), nowhere());
  const auto belief = wknn->belief_at(at_s(4.0));
  ASSERT_TRUE(belief);
  EXPECT_EQ(belief->position_m, Vector2(30.0, 5.0));
  EXPECT_EQ(belief->covariance_m2, (16.0 * core::Matrix2::Identity()).eval());
}

TEST(WknnMethod, LosesConfidenceAsItsScanAges) {
  const auto model = tiny_model();
  const auto wknn = make(*model, "wknn");
  wknn->add(heard(2.0, {{0, 0.0, {30.0, 5.0}}, {1, -9.0, {30.0, 5.0}}}), nowhere());
  const auto sigma_m = [&](double time_s) {
    const auto belief = wknn->belief_at(at_s(time_s));
    EXPECT_EQ(belief->position_m, Vector2(30.0, 5.0));
    return std::sqrt(belief->covariance_m2(0, 0));
  };
  EXPECT_NEAR(sigma_m(5.0), 4.0, 1e-12);
  EXPECT_NEAR(sigma_m(7.5), 5.0, 1e-12);  // 3 m more, by 1.2 m/s in 2.5 s.
  const auto state_at = [&](double time_s) {
    return wknn->state_at(at_s(time_s), *wknn->belief_at(at_s(time_s)));
  };
  EXPECT_EQ(state_at(4.0), core::FixState::kOk);
  EXPECT_EQ(state_at(11.0), core::FixState::kLowConfidence);
  EXPECT_EQ(state_at(60.0), core::FixState::kUnknown);
}

TEST(WknnMethod, TakesTheFloorByTheVotesOfAllScans) {
  const auto model = tiny_model();
  const auto wknn = make(*model, "wknn");
  for (int i = 0; i < 10; ++i) {
    wknn->add(heard(1.0 * i, {{1, 0.0, {3.0, 4.0}}, {0, -3.0, {9.0, 9.0}}}), nowhere());
  }
  wknn->add(heard(10.0, {{0, 0.0, {9.0, 9.0}}, {1, -3.0, {5.0, 6.0}}}), nowhere());
  const auto belief = wknn->belief_at(at_s(10.0));
  EXPECT_EQ(belief->floor, FloorId{1});
  EXPECT_EQ(belief->position_m, Vector2(5.0, 6.0));
  EXPECT_LT(belief->floor_probability, 1.0);
}

TEST(WknnMethod, KeepsItsPlaceWhenTheKnownFloorIsNotHeard) {
  const auto model = tiny_model();
  const auto wknn = make(*model, "wknn", {.known_floor = FloorId{1}, .start = {}});
  wknn->add(heard(1.0, {{0, 0.0, {3.0, 4.0}}}), nowhere());
  EXPECT_EQ(wknn->belief_at(at_s(1.0)), std::nullopt);
  wknn->add(heard(2.0, {{0, 0.0, {3.0, 4.0}}, {1, -9.0, {7.0, 8.0}}}), nowhere());
  wknn->add(heard(3.0, {{0, 0.0, {5.0, 5.0}}}), nowhere());
  const auto belief = wknn->belief_at(at_s(3.0));
  ASSERT_TRUE(belief);
  EXPECT_EQ(belief->floor, FloorId{1});
  EXPECT_EQ(belief->floor_probability, 1.0);
  EXPECT_EQ(belief->position_m, Vector2(7.0, 8.0));
}

TEST(PdrMethod, AddsStepsToItsStartAndHearsNothing) {
  const auto model = tiny_model();
  const auto pdr = make(*model, "pdr", testing::started_at({10.0, 5.0}));
  EXPECT_LT((pdr->belief_at(at_s(0.0))->position_m - Vector2(10.0, 5.0)).norm(), 1e-12);
  pdr->add(heard(0.2, {{1, 0.0, {35.0, 1.0}}}), nowhere());
  pdr->add(step_of(0.0, 0.5, 0.8, 0.5 * std::acos(-1.0)));
  pdr->add(step_of(0.5, 1.0, 0.6, 0.0));
  const auto belief = pdr->belief_at(at_s(1.0));
  EXPECT_EQ(belief->floor, FloorId{0});
  EXPECT_LT((belief->position_m - Vector2(10.6, 5.8)).norm(), 1e-12);
}

TEST(PdrMethod, IgnoresMotionThatEndedBeforeItsStart) {
  const auto model = tiny_model();
  SessionOptions options = testing::started_at({10.0, 5.0});
  options.start->time = at_s(10.0);
  const auto pdr = make(*model, "pdr", options);
  pdr->add(step_of(8.0, 8.5, 0.8, 0.0));
  EXPECT_LT((pdr->belief_at(at_s(10.0))->position_m - Vector2(10.0, 5.0)).norm(), 1e-12);
}

TEST(PdrMethod, NeedsNoScansToBeOk) {
  const auto model = tiny_model();
  const auto pdr = make(*model, "pdr", testing::started_at({10.0, 5.0}));
  pdr->hear_unknown(at_s(1.0));
  const auto belief = pdr->belief_at(at_s(200.0));
  // A metre at the start, and the walk that no step tells: sqrt(1 + 0.2^2 * 200) = 3 m.
  EXPECT_NEAR(std::sqrt(belief->covariance_m2(0, 0)), 3.0, 1e-9);
  EXPECT_EQ(pdr->state_at(at_s(200.0), *belief), core::FixState::kOk);
}

TEST(RobustMethod, IsTheFusedTracker) {
  const auto model = tiny_model();
  const auto fused = make(*model, "fused+fusion=robust");
  fusion::FusedTracker tracker(model->site(), tiny_options().fused, std::nullopt);
  walk(*fused);
  walk(tracker);
  ASSERT_TRUE(tracker.belief_at(at_s(20.2)));
  EXPECT_EQ(fused->belief_at(at_s(20.2)), tracker.belief_at(at_s(20.2)));
  const core::Belief belief = *tracker.belief_at(at_s(20.2));
  EXPECT_EQ(fused->state_at(at_s(20.2), belief), tracker.state_at(at_s(20.2), belief));
}

/// What the method says at these times is what the tracker says.
template <typename Tracker>
void expect_alike(const char* method, Tracker tracker, const Model& model,
                  std::initializer_list<double> times_s) {
  const auto estimator = make(model, method);
  walk(*estimator);
  walk(tracker);
  for (const double time_s : times_s) {
    ASSERT_TRUE(tracker.belief_at(at_s(time_s)));
    EXPECT_EQ(estimator->belief_at(at_s(time_s)), tracker.belief_at(at_s(time_s))) << time_s;
  }
}

TEST(ParticleMethods, AreTheirTrackers) {
  const auto model = tiny_model();
  const fusion::ParticleTracker::Options options = tiny_options().tracker_options();
  expect_alike("fused",
               fusion::ParticleTracker(model->site(), model->terrain(), options, std::nullopt),
               *model, {20.2, 21.0});
  expect_alike("smoothed_lag10",
               smoothing::FixedLagParticles(model->site(), model->terrain(), options, std::nullopt,
                                            std::chrono::seconds(10)),
               *model, {10.0, 14.3, 20.0, 21.0});
  expect_alike(
      "smoothed",
      smoothing::ParticleSmoother(model->site(), model->terrain(),
                                  tiny_options().particle_smoothing_options(), std::nullopt),
      *model, {0.0, 7.7, 20.0});
}

TEST(RobustWholeMethod, IsTheTrackSmoother) {
  const auto model = tiny_model();
  const auto whole = make(*model, "fused+fusion=robust_whole");
  smoothing::TrackSmoother smoother(model->site(), tiny_options().smoothing_options(),
                                    std::nullopt);
  walk(*whole);
  walk(smoother);
  for (const double time_s : {0.0, 7.7, 20.0}) {
    ASSERT_TRUE(smoother.belief_at(at_s(time_s)));
    EXPECT_EQ(whole->belief_at(at_s(time_s)), smoother.belief_at(at_s(time_s)));
  }
}

}  // namespace
}  // namespace waylode::pipeline
