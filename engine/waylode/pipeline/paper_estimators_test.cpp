// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pipeline/paper_estimators.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "waylode/pipeline/testing/tiny_site.hpp"

namespace waylode::pipeline {
namespace {

using core::FloorId;
using core::Vector2;
using fusion::testing::heard;
using fusion::testing::step_of;
using testing::at_s;
using testing::started_at;

constexpr double kNorth_rad = 0.5 * 3.14159265358979323846;

/// Linear and Gaussian: nothing is doubted but places. Answers can be worked out by hand.
fusion::StepPositionFilter::Options plain_filter() {
  fusion::StepPositionFilter::Options filter;
  filter.heading_offset_sigma_rad = 0.0;
  filter.log_scale_sigma = 0.0;
  filter.heading_offset_walk_rad_per_sqrt_step = 0.0;
  filter.log_scale_walk_per_sqrt_step = 0.0;
  filter.position_walk_m_per_sqrt_s = 1e-6;
  filter.radio_bias_sigma_m = 0.0;
  filter.radio_sigma_scale = 1.0;
  filter.radio_floor_sigma_m = 0.0;
  filter.gate = std::numeric_limits<double>::infinity();
  filter.lost_failures = 0;
  return filter;
}

Options plain_options() {
  Options options = testing::tiny_options();
  options.decision.threshold_m = 1.0;
  options.decision.pairs = 2;
  options.decision.literal_gain_ratio = 0.5;
  options.decision.filter = plain_filter();
  options.interval.start_scans = 2;
  options.interval.start_within_s = 4.0;
  options.interval.correction_ratio = 0.25;
  options.interval.magnetic_sigma_scale = 1.0;
  options.interval.magnetic_floor_sigma_m = 0.0;
  options.interval.weighting.mode = fusion::WeightingMode::kInverseVariance;
  options.interval.filter = plain_filter();
  options.feedback.hypotheses = 1;
  options.feedback.guard_gate = 5.99;
  options.feedback.guard_failures = 3;
  options.feedback.guard_window = 5;
  options.feedback.filter = plain_filter();
  options.feedback.filter.gate = 3.0;
  return options;
}

const Model& plain_model() {
  static const auto model = testing::model_of(testing::tiny_site(), plain_options());
  return *model;
}

/// From (10, 5), sure to a metre.
std::unique_ptr<Estimator> started(FusionPart part, const Model& model = plain_model()) {
  return make_paper_estimator(part, model, started_at({10.0, 5.0}));
}

/// Finds what it is given near wherever it is asked.
class Found final : public HeardAgain {
 public:
  std::optional<observation::RadioObservation> near(const core::Belief& around) const override {
    asked_m.push_back(around.position_m);
    return match;
  }
  std::vector<Vector2> alternatives(FloorId, std::size_t, double) const override {
    ++times_asked_for_alternatives;
    return places_m;
  }

  std::optional<observation::RadioObservation> match;
  std::vector<Vector2> places_m;
  mutable std::vector<Vector2> asked_m;
  mutable int times_asked_for_alternatives = 0;
};

void hear(Estimator& estimator, double time_s, const Vector2& place_m) {
  estimator.add(heard(time_s, {{0, 0.0, place_m}}), Found());
}

void feel(Estimator& estimator, double time_s, const Vector2& place_m, double variance_m2) {
  estimator.add(observation::MagneticObservation{at_s(time_s), FloorId{0}, place_m,
                                                 variance_m2 * core::Matrix2::Identity(), 0.0});
}

Vector2 place_at(const Estimator& estimator, double time_s) {
  const auto belief = estimator.belief_at(at_s(time_s));
  if (belief) return belief->position_m;
  ADD_FAILURE() << "no belief at " << time_s;
  return Vector2::Zero();
}

double variance_m2(const Estimator& estimator, double time_s) {
  return estimator.belief_at(at_s(time_s))->covariance_m2(0, 0);
}

constexpr std::array kPaperFusions = {FusionPart::kUnscented,
                                      FusionPart::kUnscentedWhenLarge,
                                      FusionPart::kPairs,
                                      FusionPart::kMagnetic,
                                      FusionPart::kIntervalsUnfiltered,
                                      FusionPart::kIntervals,
                                      FusionPart::kRawTerms,
                                      FusionPart::kFeedback,
                                      FusionPart::kFeedbackLiteral};

TEST(PaperEstimators, AreMadeForThePapersFusionsAlone) {
  for (const FusionPart part : kPaperFusions) {
    EXPECT_NE(make_paper_estimator(part, plain_model(), {}), nullptr) << static_cast<int>(part);
  }
  for (const FusionPart part :
       {FusionPart::kNewestScan, FusionPart::kDeadReckoning, FusionPart::kRobust,
        FusionPart::kRobustWhole, FusionPart::kParticles, FusionPart::kFixedLag,
        FusionPart::kWholeTrack}) {
    EXPECT_EQ(make_paper_estimator(part, plain_model(), {}), nullptr) << static_cast<int>(part);
  }
}

TEST(PaperEstimators, ReckonFromAToldStartByStepsAlone) {
  for (const FusionPart part : kPaperFusions) {
    // A constant-velocity filter lags behind a turn: that is its nature.
    if (part == FusionPart::kIntervals) continue;
    // The blend turns step by step; one direction from the start is followed exactly.
    const bool blends = part == FusionPart::kIntervalsUnfiltered;
    const double second_rad = blends ? 0.0 : kNorth_rad;
    const auto estimator = started(part);
    EXPECT_LT((place_at(*estimator, 0.0) - Vector2(10.0, 5.0)).norm(), 1e-9);
    estimator->add(step_of(0.0, 0.5, 0.8, 0.0));
    estimator->add(step_of(0.5, 1.0, 0.8, second_rad));
    const Vector2 expected_m = blends ? Vector2(11.6, 5.0) : Vector2(10.8, 5.8);
    EXPECT_LT((place_at(*estimator, 1.0) - expected_m).norm(), 1e-6) << static_cast<int>(part);
    EXPECT_GT(variance_m2(*estimator, 1.0), 1.0) << static_cast<int>(part);
  }
}

TEST(PaperEstimators, KeepASteadyWalkInAConstantVelocityFilter) {
  const auto estimator = started(FusionPart::kIntervals);
  for (int i = 0; i < 40; ++i) estimator->add(step_of(0.5 * i, 0.5 * (i + 1), 0.7, kNorth_rad));
  const Vector2 gone_m = place_at(*estimator, 20.0) - Vector2(10.0, 5.0);
  EXPECT_NEAR(gone_m.x(), 0.0, 1e-9);
  EXPECT_NEAR(gone_m.y(), 28.0, 0.2);
}

TEST(UnscentedMethod, IsAKalmanFilterWhereAllIsLinear) {
  const auto estimator = started(FusionPart::kUnscented);
  hear(*estimator, 0.0, {12.0, 5.0});
  // A start of 1 m2 and a scan of 16 m2: the gain is 1/17.
  EXPECT_NEAR(place_at(*estimator, 0.0).x(), 10.0 + 2.0 / 17.0, 1e-6);
  EXPECT_NEAR(place_at(*estimator, 0.0).y(), 5.0, 1e-9);
  EXPECT_NEAR(variance_m2(*estimator, 0.0), 16.0 / 17.0, 1e-6);
}

TEST(UnscentedMethod, CorrectsWhenLargeOnlyBeyondTheThreshold) {
  const auto estimator = started(FusionPart::kUnscentedWhenLarge);
  hear(*estimator, 0.0, {10.9, 5.0});
  EXPECT_NEAR(place_at(*estimator, 0.0).x(), 10.0, 1e-9);
  hear(*estimator, 0.0, {12.0, 5.0});
  EXPECT_NEAR(place_at(*estimator, 0.0).x(), 10.0 + 2.0 / 17.0, 1e-6);
}

TEST(PairsMethod, ShiftsTheTrackByTheMeanOfTheLastPairs) {
  const auto estimator = started(FusionPart::kPairs);
  hear(*estimator, 0.0, {12.0, 5.0});  // 2 m off: half way.
  EXPECT_LT((place_at(*estimator, 0.0) - Vector2(11.0, 5.0)).norm(), 1e-12);
  hear(*estimator, 0.0, {11.0, 9.0});  // Pairs now (1, 0) and (0, 4): half their mean.
  EXPECT_LT((place_at(*estimator, 0.0) - Vector2(11.25, 6.0)).norm(), 1e-12);
  // Pairs (-0.25, 3) and (0.75, -0.5), the first one of all forgotten; the last is too small.
  hear(*estimator, 0.0, {12.0, 5.5});
  EXPECT_LT((place_at(*estimator, 0.0) - Vector2(11.25, 6.0)).norm(), 1e-12);
  estimator->add(step_of(0.0, 0.5, 0.6, kNorth_rad));
  EXPECT_LT((place_at(*estimator, 0.5) - Vector2(11.25, 6.6)).norm(), 1e-12);
}

TEST(MagneticMethod, CarriesItsPlaceOnByTheSteps) {
  const auto estimator = started(FusionPart::kMagnetic);
  estimator->add(step_of(0.0, 0.5, 0.8, 0.0));
  feel(*estimator, 0.5, {20.0, 3.0}, 4.0);
  EXPECT_LT((place_at(*estimator, 0.5) - Vector2(20.0, 3.0)).norm(), 1e-12);
  EXPECT_EQ(variance_m2(*estimator, 0.5), 4.0);
  estimator->add(step_of(0.5, 1.0, 0.6, kNorth_rad, 0.3, 0.5));
  EXPECT_LT((place_at(*estimator, 1.0) - Vector2(20.0, 3.6)).norm(), 1e-12);
  EXPECT_NEAR(variance_m2(*estimator, 1.0), 4.0 + 0.09 + 0.09, 1e-12);
  // Half a step's time on, half a step on.
  EXPECT_LT((place_at(*estimator, 1.25) - Vector2(20.0, 3.9)).norm(), 1e-12);
}

TEST(MagneticMethod, CarriesALatePlaceForward) {
  const auto estimator = started(FusionPart::kMagnetic);
  estimator->add(step_of(0.0, 0.5, 0.8, 0.0));
  estimator->add(step_of(0.5, 1.0, 0.6, kNorth_rad));
  feel(*estimator, 0.5, {20.0, 3.0}, 4.0);
  EXPECT_LT((place_at(*estimator, 1.0) - Vector2(20.0, 3.6)).norm(), 1e-12);
}

TEST(MagneticMethod, BeginsWithTheFirstScanAndHearsNoOther) {
  const auto estimator = make_paper_estimator(FusionPart::kMagnetic, plain_model(), {});
  feel(*estimator, 0.5, {20.0, 3.0}, 4.0);  // The floor is not known yet.
  EXPECT_EQ(estimator->belief_at(at_s(0.5)), std::nullopt);
  hear(*estimator, 1.0, {12.0, 7.0});
  hear(*estimator, 2.0, {30.0, 1.0});
  EXPECT_EQ(place_at(*estimator, 2.0), Vector2(12.0, 7.0));
  EXPECT_EQ(variance_m2(*estimator, 2.0), 16.0);
}

TEST(IntervalMethod, AveragesTheFirstScansForItsStart) {
  for (const FusionPart part :
       {FusionPart::kIntervals, FusionPart::kIntervalsUnfiltered, FusionPart::kRawTerms}) {
    const auto estimator = make_paper_estimator(part, plain_model(), {});
    hear(*estimator, 1.0, {10.0, 5.0});
    hear(*estimator, 2.0, {13.0, 7.0});
    EXPECT_LT((place_at(*estimator, 2.0) - Vector2(11.5, 6.0)).norm(), 1e-9)
        << static_cast<int>(part);
  }
}

TEST(IntervalMethod, GoesPartOfTheWayToTheWeightedPoint) {
  const auto estimator = started(FusionPart::kIntervalsUnfiltered);
  hear(*estimator, 0.0, {14.0, 5.0});  // A quarter of 4 m.
  EXPECT_NEAR(place_at(*estimator, 0.0).x(), 11.0, 1e-12);
  // Magnetic 4 m2, Wi-Fi 16 m2: their point is 0.8 * 10 m + 0.2 * 14 m, and a quarter of the way.
  feel(*estimator, 0.0, {10.0, 5.0}, 4.0);
  EXPECT_NEAR(place_at(*estimator, 0.0).x(), 11.0 + 0.25 * (10.8 - 11.0), 1e-12);
}

TEST(RawTermsMethod, TakesFieldAndRadioAsMeasurementsOfOneFilter) {
  const auto estimator = started(FusionPart::kRawTerms);
  feel(*estimator, 0.0, {12.0, 5.0}, 4.0);  // 1 m2 against 4 m2: 0.8 m2 are left.
  EXPECT_NEAR(place_at(*estimator, 0.0).x(), 10.4, 1e-6);
  hear(*estimator, 0.0, {14.0, 5.0});  // 0.8 m2 against 16 m2.
  EXPECT_NEAR(place_at(*estimator, 0.0).x(), 10.4 + 3.6 * 0.8 / 16.8, 1e-6);
}

TEST(FeedbackMethod, LiteralStepsFromTheLastMatch) {
  const auto estimator = started(FusionPart::kFeedbackLiteral);
  estimator->add(step_of(0.0, 0.5, 0.8, 0.0));
  Found near;
  near.match = heard(0.5, {{0, 0.0, {11.5, 6.0}}});
  estimator->add(heard(0.5, {{0, 0.0, {35.0, 1.0}}}), near);
  ASSERT_EQ(near.asked_m.size(), 1U);
  EXPECT_LT((near.asked_m[0] - Vector2(10.8, 5.0)).norm(), 1e-6);
  EXPECT_LT((place_at(*estimator, 0.5) - Vector2(11.5, 6.0)).norm(), 1e-9);
  estimator->add(step_of(0.5, 1.0, 0.8, kNorth_rad));
  EXPECT_LT((place_at(*estimator, 1.0) - Vector2(11.5, 6.8)).norm(), 1e-6);
}

TEST(FeedbackMethod, BeginsAnewWhenTheWholeMapContradicts) {
  const auto guarded = started(FusionPart::kFeedback);
  const auto literal = started(FusionPart::kFeedbackLiteral);
  guarded->add(step_of(0.0, 0.5, 0.1, 0.0));
  literal->add(step_of(0.0, 0.5, 0.1, 0.0));
  for (int i = 1; i <= 3; ++i) {
    EXPECT_LT(place_at(*guarded, 0.5).x(), 20.0) << i;
    hear(*guarded, 1.0 * i, {35.0, 5.0});
    hear(*literal, 1.0 * i, {35.0, 5.0});
  }
  EXPECT_LT((place_at(*guarded, 3.0) - Vector2(35.0, 5.0)).norm(), 1e-6);
  EXPECT_LT(place_at(*literal, 3.0).x(), 11.0);
}

TEST(FeedbackMethod, SeeksItsStartAnywhereUntilSomebodyWalks) {
  Options options = plain_options();
  options.feedback.hypotheses = 3;
  const auto model = testing::model_of(testing::tiny_site(), options);
  const auto estimator = make_paper_estimator(FusionPart::kFeedback, *model, {});
  Found again;
  again.places_m = {{3.0, 2.0}, {30.0, 8.0}};
  estimator->add(heard(1.0, {{0, 0.0, {9.0, 9.0}}}), again);
  EXPECT_LT((place_at(*estimator, 1.0) - Vector2(3.0, 2.0)).norm(), 1e-9);
  again.places_m = {{20.0, 2.0}};
  estimator->add(heard(1.5, {{0, 0.0, {9.0, 9.0}}}), again);
  EXPECT_LT((place_at(*estimator, 1.5) - Vector2(20.0, 2.0)).norm(), 1e-9);
  again.places_m.clear();  // No map of points: the whole map's place has to do.
  estimator->add(heard(2.0, {{0, 0.0, {9.0, 9.0}}}), again);
  EXPECT_LT((place_at(*estimator, 2.0) - Vector2(9.0, 9.0)).norm(), 1e-9);
  EXPECT_TRUE(again.asked_m.empty());
  estimator->add(step_of(2.0, 2.5, 0.7, 0.0));
  estimator->add(heard(2.5, {{0, 0.0, {9.0, 9.0}}}), again);
  EXPECT_EQ(again.times_asked_for_alternatives, 3);
  EXPECT_FALSE(again.asked_m.empty());
}

TEST(FeedbackMethod, NeverSeeksElsewhereWithAToldStart) {
  const auto estimator = started(FusionPart::kFeedback);
  Found again;
  again.places_m = {{30.0, 8.0}};
  estimator->add(heard(0.2, {{0, 0.0, {10.0, 5.0}}}), again);
  EXPECT_EQ(again.times_asked_for_alternatives, 0);
  EXPECT_LT((place_at(*estimator, 0.2) - Vector2(10.0, 5.0)).norm(), 1e-6);
}

TEST(PaperEstimators, PassOverWhatIsNotSound) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const FusionPart part : kPaperFusions) {
    const auto estimator = started(part);
    estimator->add(step_of(0.0, 0.5, 0.8, 0.0));
    const Vector2 before_m = place_at(*estimator, 0.5);
    estimator->add(step_of(0.5, 1.0, kNan, 0.0));
    estimator->add(step_of(0.5, 1.0, 0.8, kNan));
    estimator->add(step_of(0.0, 0.4, 0.8, 0.0));  // Ended before the last one did.
    hear(*estimator, 0.5, {kNan, 5.0});
    feel(*estimator, 0.5, {kNan, 5.0}, 4.0);
    feel(*estimator, 0.5, {12.0, 5.0}, kNan);
    EXPECT_EQ(place_at(*estimator, 0.5), before_m) << static_cast<int>(part);
  }
}

TEST(PaperEstimators, BeginWithTheFirstScanThatIsSound) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const FusionPart part : kPaperFusions) {
    const auto estimator = make_paper_estimator(part, plain_model(), {});
    hear(*estimator, 0.5, {kNan, 5.0});
    EXPECT_EQ(estimator->belief_at(at_s(0.5)), std::nullopt) << static_cast<int>(part);
    hear(*estimator, 1.0, {12.0, 7.0});
    EXPECT_LT((place_at(*estimator, 1.0) - Vector2(12.0, 7.0)).norm(), 1e-9)
        << static_cast<int>(part);
  }
}

}  // namespace
}  // namespace waylode::pipeline
