// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/learn/relevance_vector_regression.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "waylode/core/rng.hpp"

namespace waylode::learn {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Model = RelevanceVectorRegression::Model;
using Options = RelevanceVectorRegression::Options;

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A noisy sine over [0, 1].
struct Sine {
  MatrixXd inputs;
  VectorXd targets;
  VectorXd truth;

  Sine(int count, double sigma, core::Rng& rng) : inputs(count, 1), targets(count), truth(count) {
    for (int i = 0; i < count; ++i) {
      inputs(i, 0) = rng.uniform();
      truth(i) = 5.0 + 2.0 * std::sin(7.0 * inputs(i, 0));
      targets(i) = truth(i) + sigma * rng.normal();
    }
  }
};

double rms(const VectorXd& values) {
  return std::sqrt(values.squaredNorm() / static_cast<double>(values.size()));
}

TEST(RelevanceVectorRegression, PredictsFromItsVectorsWeightsAndCovariance) {
  const Model model{.kernel = {.spline_weight = 0.0,
                               .gauss_weight = 1.0,
                               .laplace_weight = 0.0,
                               .gauss_rate = 4.0},
                    .offset = 10.0,
                    .has_bias = true,
                    .vectors = MatrixXd{{0.25}, {0.75}},
                    .weights = VectorXd{{0.5, 2.0, -3.0}},
                    .covariance = MatrixXd{{0.2, 0.0, 0.01}, {0.0, 0.3, 0.05}, {0.01, 0.05, 0.4}},
                    .noise_variance = 0.09};
  const auto regression = RelevanceVectorRegression::from_model(model);
  ASSERT_TRUE(regression);
  const auto prediction = regression->predict(MatrixXd{{0.5}, {1.25}});
  ASSERT_TRUE(prediction);
  // At 0.5 both kernels are exp(-4/16), at 1.25 they are exp(-4) and exp(-1).
  const std::array phis{VectorXd{{1.0, std::exp(-0.25), std::exp(-0.25)}},
                        VectorXd{{1.0, std::exp(-4.0), std::exp(-1.0)}}};
  for (int i = 0; i < 2; ++i) {
    const VectorXd& phi = phis.at(static_cast<std::size_t>(i));
    EXPECT_NEAR(prediction->mean(i), 10.0 + 0.5 + 2.0 * phi(1) - 3.0 * phi(2), 1e-12);
    EXPECT_NEAR(prediction->sigma(i), std::sqrt(0.09 + phi.dot(model.covariance * phi)), 1e-12);
  }
}

TEST(RelevanceVectorRegression, LearnsACurveFromFewOfItsSamples) {
  core::Rng rng(3);
  const Sine sine(200, 0.3, rng);
  const auto training = train_relevance_vectors(sine.inputs, sine.targets, {});
  ASSERT_TRUE(training);
  EXPECT_TRUE(training->fit.converged);
  EXPECT_LT(training->regression.vector_count(), 30U);
  EXPECT_NEAR(std::sqrt(training->regression.model().noise_variance), 0.3, 0.05);
  const auto prediction = training->regression.predict(sine.inputs);
  ASSERT_TRUE(prediction);
  // Some 10 free parameters leave sigma sqrt(10 / 200) of error.
  EXPECT_LT(rms(prediction->mean - sine.truth), 0.3 * std::sqrt(20.0 / 200.0));
}

TEST(RelevanceVectorRegression, PutsTwoThirdsOfNewTargetsWithinOneSigma) {
  int inside_one = 0;
  int inside_two = 0;
  int all = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    core::Rng rng(seed);
    const Sine sine(200, 0.3, rng);
    const Sine fresh(500, 0.3, rng);
    const auto regression = RelevanceVectorRegression::train(sine.inputs, sine.targets, {});
    ASSERT_TRUE(regression);
    const auto prediction = regression->predict(fresh.inputs);
    ASSERT_TRUE(prediction);
    const VectorXd ratio =
        (prediction->mean - fresh.targets).cwiseAbs().cwiseQuotient(prediction->sigma);
    inside_one += static_cast<int>((ratio.array() < 1.0).count());
    inside_two += static_cast<int>((ratio.array() < 2.0).count());
    all += 500;
  }
  EXPECT_NEAR(static_cast<double>(inside_one) / all, 0.683, 0.03);
  EXPECT_NEAR(static_cast<double>(inside_two) / all, 0.954, 0.02);
}

TEST(RelevanceVectorRegression, LearnsSixHundredSamples) {
  core::Rng rng(9);
  const Sine sine(600, 0.3, rng);
  const auto training = train_relevance_vectors(sine.inputs, sine.targets, {});
  ASSERT_TRUE(training);
  EXPECT_TRUE(training->fit.converged);
  // A third of the noise: as if of 67 free parameters.
  EXPECT_LT(rms(training->regression.predict(sine.inputs)->mean - sine.truth), 0.1);
}

TEST(RelevanceVectorRegression, IsTheSameForTheSameSamples) {
  core::Rng rng(4);
  const Sine sine(50, 0.3, rng);
  const auto first = RelevanceVectorRegression::train(sine.inputs, sine.targets, {});
  const auto second = RelevanceVectorRegression::train(sine.inputs, sine.targets, {});
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->model().weights, second->model().weights);
  EXPECT_EQ(first->model().covariance, second->model().covariance);
}

TEST(RelevanceVectorRegression, FollowsAShiftOfTheTargets) {
  core::Rng rng(4);
  const Sine sine(60, 0.3, rng);
  const auto here = RelevanceVectorRegression::train(sine.inputs, sine.targets, {});
  const auto there =
      RelevanceVectorRegression::train(sine.inputs, sine.targets.array() + 1000.0, {});
  ASSERT_TRUE(here && there);
  const auto prediction = here->predict(sine.inputs);
  const auto shifted = there->predict(sine.inputs);
  EXPECT_TRUE(shifted->mean.isApprox((prediction->mean.array() + 1000.0).matrix(), 1e-6));
  EXPECT_TRUE(shifted->sigma.isApprox(prediction->sigma, 1e-6));
}

TEST(RelevanceVectorRegression, DoesWithoutBiasAndCentringWhenTold) {
  core::Rng rng(4);
  const Sine sine(60, 0.3, rng);
  Options options{.bias = false, .centre_targets = false};
  const auto regression = RelevanceVectorRegression::train(sine.inputs, sine.targets, options);
  ASSERT_TRUE(regression);
  EXPECT_FALSE(regression->model().has_bias);
  EXPECT_EQ(regression->model().offset, 0.0);
  EXPECT_EQ(regression->model().weights.size(), regression->model().vectors.rows());
  EXPECT_LT(rms(regression->predict(sine.inputs)->mean - sine.truth), 0.2);
}

TEST(RelevanceVectorRegression, KeepsOnlyTheBiasForAFlatLineFarFromZero) {
  core::Rng rng(8);
  MatrixXd inputs(40, 1);
  VectorXd targets(40);
  for (int i = 0; i < 40; ++i) {
    inputs(i, 0) = rng.uniform();
    targets(i) = 20.0 + 0.1 * rng.normal();
  }
  Options options{.kernel = {.spline_weight = 0.0, .laplace_weight = 0.0, .gauss_rate = 500.0},
                  .centre_targets = false};
  const auto regression = RelevanceVectorRegression::train(inputs, targets, options);
  ASSERT_TRUE(regression);
  EXPECT_TRUE(regression->model().has_bias);
  EXPECT_NEAR(regression->predict(MatrixXd{{0.4}})->mean(0), 20.0, 0.15);
}

TEST(RelevanceVectorRegression, PredictsTheConstantOfConstantTargets) {
  const MatrixXd inputs{{0.1}, {0.4}, {0.9}};
  Options options;
  options.fit.min_noise_sigma = 0.02;
  const auto regression =
      RelevanceVectorRegression::train(inputs, VectorXd::Constant(3, -7.5), options);
  ASSERT_TRUE(regression);
  EXPECT_EQ(regression->vector_count(), 0U);
  EXPECT_EQ(regression->dimensions(), 1);
  const auto prediction = regression->predict(MatrixXd{{0.6}});
  ASSERT_TRUE(prediction);
  EXPECT_DOUBLE_EQ(prediction->mean(0), -7.5);
  EXPECT_DOUBLE_EQ(prediction->sigma(0), 0.02);
}

TEST(RelevanceVectorRegression, SettlesBetweenTheTargetsOfEqualInputs) {
  MatrixXd inputs(40, 1);
  VectorXd targets(40);
  for (int i = 0; i < 40; ++i) {
    inputs(i, 0) = i < 20 ? 0.2 : 0.8;
    targets(i) = (i < 20 ? 3.0 : 11.0) + (i % 2 == 0 ? 0.5 : -0.5);
  }
  const auto regression = RelevanceVectorRegression::train(inputs, targets, {});
  ASSERT_TRUE(regression);
  const auto prediction = regression->predict(MatrixXd{{0.2}, {0.8}});
  EXPECT_NEAR(prediction->mean(0), 3.0, 0.1);
  EXPECT_NEAR(prediction->mean(1), 11.0, 0.1);
  EXPECT_NEAR(prediction->sigma(0), 0.5, 0.05);
}

TEST(RelevanceVectorRegression, RefusesSamplesItCannotLearnFrom) {
  const auto code = [](const MatrixXd& inputs, const VectorXd& targets) {
    const auto regression = RelevanceVectorRegression::train(inputs, targets, {});
    return regression ? core::ErrorCode::kInternal : regression.error().code;
  };
  constexpr auto kRefused = core::ErrorCode::kInvalidArgument;
  EXPECT_EQ(code(MatrixXd(0, 1), VectorXd(0)), kRefused);
  EXPECT_EQ(code(MatrixXd{{0.5}}, VectorXd{{2.0}}), kRefused);
  EXPECT_EQ(code(MatrixXd(3, 0), VectorXd::Ones(3)), kRefused);
  EXPECT_EQ(code(MatrixXd{{0.1}, {0.2}}, VectorXd{{1.0, 2.0, 3.0}}), kRefused);
  EXPECT_EQ(code(MatrixXd{{0.1}, {kNan}}, VectorXd{{1.0, 2.0}}), kRefused);
  EXPECT_EQ(code(MatrixXd{{0.1}, {kInf}}, VectorXd{{1.0, 2.0}}), kRefused);
  EXPECT_EQ(code(MatrixXd{{0.1}, {0.2}}, VectorXd{{1.0, kNan}}), kRefused);
  // The spline of so many dimensions overflows.
  EXPECT_EQ(code(MatrixXd::Constant(2, 2000, 0.9), VectorXd{{1.0, 2.0}}), kRefused);
}

TEST(RelevanceVectorRegression, RefusesInputsItCannotPredictFor) {
  const MatrixXd inputs{{0.1}, {0.5}, {0.9}};
  for (const VectorXd& targets : {VectorXd{{1.0, 2.0, 2.5}}, VectorXd{{2.0, 2.0, 2.0}}}) {
    const auto regression = RelevanceVectorRegression::train(inputs, targets, {});
    ASSERT_TRUE(regression);
    EXPECT_FALSE(regression->predict(MatrixXd{{0.1, 0.2}}));
    EXPECT_FALSE(regression->predict(MatrixXd{{kNan}}));
    EXPECT_FALSE(regression->predict(MatrixXd{{0.3}, {kInf}}));
    const auto none = regression->predict(MatrixXd(0, 1));
    ASSERT_TRUE(none);
    EXPECT_EQ(none->mean.size(), 0);
  }
}

TEST(RelevanceVectorRegression, RefusesOptionsOutOfRange) {
  Options options;
  options.kernel.gauss_rate = -1.0;
  EXPECT_FALSE(options.validate());
  options = {};
  options.fit.tolerance = 0.0;
  const auto refused =
      RelevanceVectorRegression::train(MatrixXd{{0.1}, {0.2}}, VectorXd{{1.0, 2.0}}, options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, core::ErrorCode::kInvalidOptions);
}

TEST(RelevanceVectorRegression, RefusesModelsThatAreNone) {
  const Model sound{.kernel = {},
                    .offset = 1.0,
                    .has_bias = false,
                    .vectors = MatrixXd{{0.25}, {0.75}},
                    .weights = VectorXd{{2.0, -3.0}},
                    .covariance = MatrixXd{{0.3, 0.1}, {0.1, 0.4}},
                    .noise_variance = 0.09};
  const auto refused = [&](auto&& damage) {
    Model model = sound;
    damage(model);
    return !RelevanceVectorRegression::from_model(model);
  };
  EXPECT_FALSE(refused([](Model&) {}));
  EXPECT_TRUE(refused([](Model& m) { m.has_bias = true; }));
  EXPECT_TRUE(refused([](Model& m) { m.vectors = MatrixXd(2, 0); }));
  EXPECT_TRUE(refused([](Model& m) { m.vectors(1, 0) = kNan; }));
  EXPECT_TRUE(refused([](Model& m) { m.weights(0) = kInf; }));
  EXPECT_TRUE(refused([](Model& m) { m.offset = kNan; }));
  EXPECT_TRUE(refused([](Model& m) { m.covariance = MatrixXd::Identity(3, 3); }));
  EXPECT_TRUE(refused([](Model& m) { m.covariance(0, 1) = 0.2; }));
  EXPECT_TRUE(refused([](Model& m) { m.covariance << 0.3, 0.4, 0.4, 0.4; }));
  EXPECT_TRUE(refused([](Model& m) { m.covariance(1, 1) = kNan; }));
  EXPECT_TRUE(refused([](Model& m) { m.noise_variance = 0.0; }));
  EXPECT_TRUE(refused([](Model& m) { m.noise_variance = kInf; }));
  EXPECT_TRUE(refused([](Model& m) { m.kernel.gauss_rate = 0.0; }));
}

TEST(ChooseKernel, TakesTheOneOfTheGreatestEvidence) {
  core::Rng rng(6);
  const Sine sine(80, 0.3, rng);
  const auto gauss = [](double rate) {
    return Kernel::Options{
        .spline_weight = 0.0, .gauss_weight = 1.0, .laplace_weight = 0.0, .gauss_rate = rate};
  };
  // A wave of 7 rad is neither as straight as the first nor as rough as the last.
  const std::array kernels{gauss(1e-3), gauss(10.0), gauss(1e5)};
  const auto chosen = choose_kernel(sine.inputs, sine.targets, kernels, {});
  ASSERT_TRUE(chosen);
  EXPECT_EQ(*chosen, kernels[1]);
  EXPECT_FALSE(choose_kernel(sine.inputs, sine.targets, {}, {}));
  EXPECT_FALSE(choose_kernel(MatrixXd(0, 1), VectorXd(0), kernels, {}));
}

}  // namespace
}  // namespace waylode::learn
