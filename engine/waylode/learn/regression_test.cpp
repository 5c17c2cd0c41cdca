// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/learn/regression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "waylode/core/rng.hpp"

namespace waylode::learn {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Strengths that fall along x and y.
struct Map {
  MatrixXd strengths_dbm{60, 2};
  MatrixXd places_m{60, 2};

  Map() {
    core::Rng rng(12);
    for (int i = 0; i < 60; ++i) {
      places_m(i, 0) = rng.uniform(0.0, 8.0);
      places_m(i, 1) = rng.uniform(0.0, 3.0);
      strengths_dbm(i, 0) = -40.0 - 4.0 * places_m(i, 0) + 0.5 * rng.normal();
      strengths_dbm(i, 1) = -50.0 - 6.0 * places_m(i, 1) + 0.5 * rng.normal();
    }
  }
};

const Regression::Options kSupport{.scaler = {},
                                   .regressor = SupportVectorRegression::Options{.cost = 100.0}};

TEST(Regression, LearnsEachOutputFromTheScaledInputs) {
  const Map map;
  const auto regression = Regression::train(map.strengths_dbm, map.places_m, {});
  ASSERT_TRUE(regression);
  EXPECT_EQ(regression->dimensions(), 2);
  ASSERT_EQ(regression->outputs().size(), 2U);
  const MatrixXd scaled = InputScaler::learn(map.strengths_dbm, {})->scale(map.strengths_dbm);
  const auto estimate = regression->predict(map.strengths_dbm);
  ASSERT_TRUE(estimate && estimate->sigma);
  for (int column = 0; column < 2; ++column) {
    const auto alone =
        RelevanceVectorRegression::train(scaled, map.places_m.col(column), {})->predict(scaled);
    EXPECT_EQ(VectorXd(estimate->mean.col(column)), alone->mean);
    EXPECT_EQ(VectorXd(estimate->sigma->col(column)), alone->sigma);
  }
}

TEST(Regression, TellsAPlaceWithItsCovariance) {
  const Map map;
  const auto regression = Regression::train(map.strengths_dbm, map.places_m, {});
  ASSERT_TRUE(regression);
  const auto place = predict_place(*regression, VectorXd{{-60.0, -56.0}});
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->position_m.x(), 5.0, 0.4);
  EXPECT_NEAR(place->position_m.y(), 1.0, 0.4);
  // Half a decibel is an eighth of a metre along x and a twelfth along y.
  EXPECT_NEAR(std::sqrt(place->covariance_m2(0, 0)), 0.125, 0.03);
  EXPECT_NEAR(std::sqrt(place->covariance_m2(1, 1)), 0.083, 0.03);
  EXPECT_EQ(place->covariance_m2(0, 1), 0.0);
}

TEST(Regression, ClipsInputsFarOutside) {
  const Map map;
  const auto regression = Regression::train(map.strengths_dbm, map.places_m, {});
  ASSERT_TRUE(regression);
  EXPECT_EQ(regression->predict(MatrixXd{{-1e6, 1e6}})->mean,
            regression->predict(MatrixXd{{-1e9, 1e9}})->mean);
}

TEST(Regression, OfSupportVectorsKnowsNoSigma) {
  const Map map;
  const auto regression = Regression::train(map.strengths_dbm, map.places_m, kSupport);
  ASSERT_TRUE(regression);
  const auto estimate = regression->predict(MatrixXd{{-60.0, -56.0}});
  ASSERT_TRUE(estimate);
  EXPECT_FALSE(estimate->sigma);
  EXPECT_NEAR(estimate->mean(0, 0), 5.0, 0.5);
  EXPECT_FALSE(predict_place(*regression, VectorXd{{-60.0, -56.0}}));
}

TEST(Regression, RefusesWhatItCannotLearnFrom) {
  const Map map;
  EXPECT_FALSE(Regression::train(map.strengths_dbm, MatrixXd(60, 0), {}));
  EXPECT_FALSE(Regression::train(map.strengths_dbm, map.places_m.topRows(59), {}));
  EXPECT_FALSE(Regression::train(MatrixXd(0, 2), MatrixXd(0, 2), {}));
  MatrixXd places_m = map.places_m;
  places_m(7, 1) = kNan;
  EXPECT_FALSE(Regression::train(map.strengths_dbm, places_m, {}));
  EXPECT_FALSE(Regression::train(map.strengths_dbm, places_m, kSupport));
  Regression::Options options;
  options.scaler.clip_high = 0.0;
  EXPECT_EQ(Regression::train(map.strengths_dbm, map.places_m, options).error().code,
            core::ErrorCode::kInvalidOptions);
}

TEST(Regression, RefusesInputsItCannotPredictFor) {
  const Map map;
  const auto regression = Regression::train(map.strengths_dbm, map.places_m, {});
  ASSERT_TRUE(regression);
  EXPECT_FALSE(regression->predict(MatrixXd{{-60.0}}));
  EXPECT_FALSE(regression->predict(MatrixXd{{-60.0, kNan}}));
  EXPECT_FALSE(regression->predict(MatrixXd{{-kInf, -60.0}}));
  EXPECT_FALSE(predict_place(*regression, VectorXd{{-60.0}}));
  const auto three = Regression::train(map.strengths_dbm, MatrixXd::Random(60, 3), {});
  ASSERT_TRUE(three);
  EXPECT_FALSE(predict_place(*three, VectorXd{{-60.0, -56.0}}));
}

TEST(Regression, RefusesPartsThatDoNotMatch) {
  const auto scaler = InputScaler::from_range(0.0, 1.0, {});
  const auto of_dimensions = [](Eigen::Index count) {
    return *SupportVectorRegression::from_model({1.0, 0.0, MatrixXd(0, count), VectorXd(0)});
  };
  EXPECT_FALSE(Regression::from_parts(*scaler, {}));
  EXPECT_FALSE(Regression::from_parts(*scaler, {of_dimensions(2), of_dimensions(3)}));
  EXPECT_TRUE(Regression::from_parts(*scaler, {of_dimensions(2), of_dimensions(2)}));
}

}  // namespace
}  // namespace waylode::learn
