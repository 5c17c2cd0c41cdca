// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/learn/support_vector_regression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "waylode/core/rng.hpp"

namespace waylode::learn {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Model = SupportVectorRegression::Model;
using Options = SupportVectorRegression::Options;

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Of two samples (0, 1), (1, -1) the weights are b and -b and the bias is 0, by symmetry;
/// the residual is epsilon unless b reaches C first.
const MatrixXd kTwoInputs{{0.0}, {1.0}};
const VectorXd kTwoTargets{{1.0, -1.0}};

TEST(SupportVectorRegression, SolvesTwoSamplesAsByHand) {
  const auto regression = SupportVectorRegression::train(
      kTwoInputs, kTwoTargets,
      {.cost = 10.0, .epsilon = 0.2, .gauss_rate = 0.5, .tolerance = 1e-9});
  ASSERT_TRUE(regression);
  ASSERT_EQ(regression->vector_count(), 2U);
  const double expected = 0.8 / (1.0 - std::exp(-0.5));
  EXPECT_NEAR(regression->model().weights.cwiseAbs().maxCoeff(), expected, 1e-6);
  EXPECT_NEAR(regression->model().bias, 0.0, 1e-6);
  const auto values = regression->predict(MatrixXd{{0.0}, {0.5}, {1.0}});
  ASSERT_TRUE(values);
  EXPECT_TRUE(values->isApprox(VectorXd{{0.8, 0.0, -0.8}}, 1e-6)) << *values;
}

TEST(SupportVectorRegression, BoundsTheWeightsByTheCost) {
  const auto regression = SupportVectorRegression::train(
      kTwoInputs, kTwoTargets, {.cost = 1.5, .epsilon = 0.2, .gauss_rate = 0.5, .tolerance = 1e-9});
  ASSERT_TRUE(regression);
  ASSERT_LT(1.5, 0.8 / (1.0 - std::exp(-0.5)));
  EXPECT_NEAR(regression->model().weights.cwiseAbs().maxCoeff(), 1.5, 1e-9);
  const auto values = regression->predict(kTwoInputs);
  EXPECT_NEAR((*values)(0) - (*values)(1), 2.0 * 1.5 * (1.0 - std::exp(-0.5)), 1e-6);
}

struct Cloud {
  MatrixXd inputs{40, 2};
  VectorXd targets{40};

  Cloud() {
    core::Rng rng(21);
    for (int i = 0; i < 40; ++i) {
      inputs(i, 0) = rng.uniform();
      inputs(i, 1) = rng.uniform();
      targets(i) = 3.0 * inputs(i, 0) - std::cos(5.0 * inputs(i, 1)) + 0.4 * rng.normal();
    }
  }
};

/// The weight of a training sample, 0 unless it is a support vector.
double weight_of(const Model& model, const MatrixXd& inputs, Eigen::Index sample) {
  for (Eigen::Index j = 0; j < model.vectors.rows(); ++j) {
    if (model.vectors.row(j) == inputs.row(sample)) return model.weights(j);
  }
  return 0.0;
}

TEST(SupportVectorRegression, MeetsTheConditionsOfTheOptimum) {
  const Cloud cloud;
  const Options options{.cost = 2.0, .epsilon = 0.3, .gauss_rate = 3.0, .tolerance = 1e-9};
  const auto regression = SupportVectorRegression::train(cloud.inputs, cloud.targets, options);
  ASSERT_TRUE(regression);
  const auto values = regression->predict(cloud.inputs);
  ASSERT_TRUE(values);
  // Karush-Kuhn-Tucker: these hold at the minimum of the convex problem and nowhere else.
  EXPECT_NEAR(regression->model().weights.sum(), 0.0, 1e-9);
  constexpr double kClose = 1e-6;
  int at_bound = 0;
  for (Eigen::Index i = 0; i < 40; ++i) {
    const double residual = cloud.targets(i) - (*values)(i);
    const double weight = weight_of(regression->model(), cloud.inputs, i);
    if (weight == 0.0) {
      EXPECT_LE(std::abs(residual), 0.3 + kClose);
      continue;
    }
    EXPECT_LE(std::abs(weight), 2.0 + kClose);
    EXPECT_GT(residual * weight, 0.0);
    if (std::abs(weight) < 2.0 - kClose) {
      EXPECT_NEAR(std::abs(residual), 0.3, kClose);
    } else {
      EXPECT_GE(std::abs(residual), 0.3 - kClose);
      ++at_bound;
    }
  }
  EXPECT_GT(at_bound, 0);
  EXPECT_LT(at_bound, static_cast<int>(regression->vector_count()));
}

TEST(SupportVectorRegression, TakesItsRateFromTheSpreadOfTheInputs) {
  // Mean 2, variance 5/2 over all; two columns.
  const auto regression =
      SupportVectorRegression::train(MatrixXd{{1.0, 0.0}, {3.0, 4.0}}, VectorXd{{0.0, 5.0}}, {});
  ASSERT_TRUE(regression);
  EXPECT_NEAR(regression->model().gauss_rate, 1.0 / (2.0 * 2.5), 1e-15);
}

TEST(SupportVectorRegression, IsSilentAndTheSameForTheSameSamples) {
  const Cloud cloud;
  testing::internal::CaptureStdout();
  const auto first = SupportVectorRegression::train(cloud.inputs, cloud.targets, {});
  const auto second = SupportVectorRegression::train(cloud.inputs, cloud.targets, {});
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->model().weights, second->model().weights);
  EXPECT_EQ(first->model().vectors, second->model().vectors);
  EXPECT_EQ(first->model().bias, second->model().bias);
}

TEST(SupportVectorRegression, NeedsNoVectorForTargetsWithinEpsilon) {
  for (const MatrixXd& inputs : {MatrixXd{{0.1}, {0.5}, {0.9}}, MatrixXd{{0.3}, {0.3}, {0.3}}}) {
    const auto regression = SupportVectorRegression::train(inputs, VectorXd{{4.0, 4.05, 3.98}}, {});
    ASSERT_TRUE(regression);
    EXPECT_EQ(regression->vector_count(), 0U);
    EXPECT_EQ(regression->dimensions(), 1);
    EXPECT_NEAR((*regression->predict(MatrixXd{{7.0}}))(0), 4.0, 0.1);
  }
}

TEST(SupportVectorRegression, RepeatsASingleSample) {
  const auto regression = SupportVectorRegression::train(MatrixXd{{0.2}}, VectorXd{{-3.0}}, {});
  ASSERT_TRUE(regression);
  EXPECT_NEAR((*regression->predict(MatrixXd{{0.2}}))(0), -3.0, 0.1 + 1e-9);
}

TEST(SupportVectorRegression, RefusesSamplesItCannotLearnFrom) {
  const auto code = [](const MatrixXd& inputs, const VectorXd& targets) {
    const auto regression = SupportVectorRegression::train(inputs, targets, {});
    return regression ? core::ErrorCode::kInternal : regression.error().code;
  };
  constexpr auto kRefused = core::ErrorCode::kInvalidArgument;
  EXPECT_EQ(code(MatrixXd(0, 1), VectorXd(0)), kRefused);
  EXPECT_EQ(code(MatrixXd(3, 0), VectorXd::Ones(3)), kRefused);
  EXPECT_EQ(code(MatrixXd{{0.1}, {0.2}}, VectorXd{{1.0}}), kRefused);
  EXPECT_EQ(code(MatrixXd{{0.1}, {kNan}}, VectorXd{{1.0, 2.0}}), kRefused);
  EXPECT_EQ(code(MatrixXd{{0.1}, {0.2}}, VectorXd{{1.0, -kInf}}), kRefused);
  EXPECT_EQ(code(MatrixXd{{0.1}, {1e200}}, VectorXd{{1.0, 2.0}}), kRefused);
}

TEST(SupportVectorRegression, RefusesInputsItCannotPredictFor) {
  const auto regression = SupportVectorRegression::train(kTwoInputs, kTwoTargets, {});
  ASSERT_TRUE(regression);
  EXPECT_FALSE(regression->predict(MatrixXd{{0.1, 0.2}}));
  EXPECT_FALSE(regression->predict(MatrixXd{{kNan}}));
  EXPECT_FALSE(regression->predict(MatrixXd{{kInf}}));
  EXPECT_EQ(regression->predict(MatrixXd(0, 1))->size(), 0);
}

TEST(SupportVectorRegression, RefusesOptionsOutOfRange) {
  for (const Options& options :
       {Options{.cost = 0.0}, Options{.cost = kNan}, Options{.cost = 1e7}, Options{.epsilon = -0.1},
        Options{.epsilon = kInf}, Options{.gauss_rate = 0.0}, Options{.gauss_rate = kInf},
        Options{.tolerance = 0.0}, Options{.tolerance = kNan}}) {
    const auto refused = SupportVectorRegression::train(kTwoInputs, kTwoTargets, options);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, core::ErrorCode::kInvalidOptions);
  }
}

TEST(SupportVectorRegression, RefusesModelsThatAreNone) {
  const auto refused = [](const Model& model) {
    return !SupportVectorRegression::from_model(model);
  };
  const MatrixXd vectors{{0.2}, {0.4}};
  const VectorXd weights{{1.0, -1.0}};
  EXPECT_FALSE(refused({2.0, 0.5, vectors, weights}));
  EXPECT_TRUE(refused({0.0, 0.5, vectors, weights}));
  EXPECT_TRUE(refused({kNan, 0.5, vectors, weights}));
  EXPECT_TRUE(refused({2.0, kInf, vectors, weights}));
  EXPECT_TRUE(refused({2.0, 0.5, MatrixXd{{0.2}}, weights}));
  EXPECT_TRUE(refused({2.0, 0.5, MatrixXd(2, 0), weights}));
  EXPECT_TRUE(refused({2.0, 0.5, MatrixXd{{0.2}, {kNan}}, weights}));
  EXPECT_TRUE(refused({2.0, 0.5, vectors, VectorXd{{1.0, kInf}}}));
}

}  // namespace
}  // namespace waylode::learn
