// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/learn/kernel.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

namespace waylode::learn {
namespace {

using Eigen::MatrixXd;

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

MatrixXd matrix(const Kernel::Options& options, const MatrixXd& a, const MatrixXd& b) {
  return Kernel::create(options)->matrix(a, b);
}

MatrixXd row(double x, double y) { return MatrixXd{{x, y}}; }

constexpr Kernel::Options kAsymmetric{.spline_weight = 0.5,
                                      .gauss_weight = 2.0,
                                      .laplace_weight = 3.0,
                                      .gauss_rate = 1.5,
                                      .laplace_rate = 4.0};

TEST(Kernel, SplineIsOnePlusProductPlusIntegralOverTheKnots) {
  for (const auto& [x, y] :
       {std::pair{0.25, 0.75}, {0.9, 0.4}, {0.3, 0.3}, {1.2, 0.0}, {-0.2, 1.1}, {-0.4, -0.7}}) {
    constexpr int kSteps = 20'000;
    double integral = 0.0;  // Of (x - t)+ (y - t)+ over t >= 0, by the midpoint rule.
    for (int i = 0; i < kSteps; ++i) {
      const double t = 2.0 * (i + 0.5) / kSteps;
      integral += std::max(0.0, x - t) * std::max(0.0, y - t) * 2.0 / kSteps;
    }
    EXPECT_NEAR(spline_kernel(x, y), 1.0 + x * y + integral, 1e-6) << x << ' ' << y;
  }
}

TEST(Kernel, SplineAsPrintedByHand) {
  // 1 + 3/16 + 3/64 - 1/2 * 1/16 + 1/192
  EXPECT_NEAR(spline_kernel(0.25, 0.75), 29.0 / 24.0, 1e-15);
  EXPECT_DOUBLE_EQ(spline_kernel(0.25, 0.75), spline_kernel(0.75, 0.25));
}

TEST(Kernel, GaussAndLaplaceFallWithSquaredAndPlainDistance) {
  EXPECT_DOUBLE_EQ(gauss_kernel(0.25, 3.0), std::exp(-0.75));
  EXPECT_DOUBLE_EQ(laplace_kernel(0.25, 9.0), std::exp(-1.5));
}

TEST(Kernel, SumsTheWeightedParts) {
  const double spline = spline_kernel(0.1, 0.4) * spline_kernel(0.9, 0.5);
  const double distance2 = 0.09 + 0.16;
  const double expected =
      0.5 * spline + 2.0 * std::exp(-1.5 * distance2) + 3.0 * std::exp(-std::sqrt(4.0 * distance2));
  EXPECT_NEAR(matrix(kAsymmetric, row(0.1, 0.9), row(0.4, 0.5))(0, 0), expected, 1e-14);
}

TEST(Kernel, MultipliesThePartsToTheirWeights) {
  Kernel::Options options = kAsymmetric;
  options.combination = Kernel::Combination::kProduct;
  const double spline = spline_kernel(0.1, 0.4) * spline_kernel(0.9, 0.5);
  const double expected =
      std::sqrt(spline) * std::exp(-1.5 * 2.0 * 0.25) * std::exp(-3.0 * std::sqrt(4.0 * 0.25));
  EXPECT_NEAR(matrix(options, row(0.1, 0.9), row(0.4, 0.5))(0, 0), expected, 1e-14);
}

TEST(Kernel, LeavesOutPartsOfNoWeight) {
  const Kernel::Options gauss{.spline_weight = 0.0, .laplace_weight = 0.0, .gauss_rate = 2.0};
  EXPECT_NEAR(matrix(gauss, row(0.0, 0.5), row(0.5, 0.5))(0, 0), std::exp(-0.5) / 3.0, 1e-15);
  Kernel::Options product{.combination = Kernel::Combination::kProduct,
                          .spline_weight = 0.0,
                          .gauss_weight = 1.0,
                          .laplace_weight = 0.0,
                          .gauss_rate = 2.0};
  EXPECT_NEAR(matrix(product, row(0.0, 0.5), row(0.5, 0.5))(0, 0), std::exp(-0.5), 1e-15);
}

TEST(Kernel, HasARowPerFirstAndAColumnPerSecondInput) {
  const MatrixXd a{{0.1}, {0.7}, {0.3}};
  const MatrixXd b{{0.2}, {0.9}};
  const MatrixXd values = matrix(kAsymmetric, a, b);
  ASSERT_EQ(values.rows(), 3);
  ASSERT_EQ(values.cols(), 2);
  EXPECT_DOUBLE_EQ(values(1, 0), matrix(kAsymmetric, a.row(1), b.row(0))(0, 0));
  EXPECT_EQ(matrix(kAsymmetric, MatrixXd(0, 1), b).rows(), 0);
}

TEST(Kernel, NormalisedSplineIsTheCosineOfThePlainOne) {
  Kernel::Options plain{.gauss_weight = 0.0, .laplace_weight = 0.0};
  plain.spline_weight = 1.0;
  Kernel::Options normalised = plain;
  normalised.normalise_spline = true;
  const MatrixXd a = row(0.2, 0.9);
  const MatrixXd b = row(-0.2, 0.6);
  const double expected =
      matrix(plain, a, b)(0, 0) / std::sqrt(matrix(plain, a, a)(0, 0) * matrix(plain, b, b)(0, 0));
  EXPECT_NEAR(matrix(normalised, a, b)(0, 0), expected, 1e-14);
  EXPECT_NEAR(matrix(normalised, a, a)(0, 0), 1.0, 1e-14);
}

TEST(Kernel, NormalisedSplineKeepsItsSign) {
  Kernel::Options options{.gauss_weight = 0.0, .laplace_weight = 0.0, .normalise_spline = true};
  options.spline_weight = 1.0;
  // S(-2, 3) = 1 - 6, S(-2, -2) = 1 + 4, S(3, 3) = 1 + 9 + 27/3
  EXPECT_NEAR(matrix(options, MatrixXd{{-2.0}}, MatrixXd{{3.0}})(0, 0),
              -5.0 / std::sqrt(5.0 * 19.0), 1e-14);
}

TEST(Kernel, NormalisedSplineBearsThousandsOfDimensions) {
  Kernel::Options options;
  const MatrixXd inputs = MatrixXd::Constant(2, 2000, 0.9);
  EXPECT_FALSE(matrix(options, inputs, inputs).allFinite());
  options.normalise_spline = true;
  EXPECT_NEAR(matrix(options, inputs, inputs)(0, 1), 1.0, 1e-9);
}

RC_GTEST_PROP(KernelProperty, SumOfSeveralInputsIsSymmetricAndPositiveSemidefinite, ()) {
  const auto values = *rc::gen::container<std::vector<int>>(24, rc::gen::inRange(-500, 1500));
  MatrixXd inputs(8, 3);
  for (int i = 0; i < 24; ++i) inputs(i / 3, i % 3) = values[static_cast<std::size_t>(i)] / 1000.0;
  Kernel::Options options = kAsymmetric;
  options.normalise_spline = *rc::gen::arbitrary<bool>();
  const MatrixXd kernel = matrix(options, inputs, inputs);
  RC_ASSERT((kernel - kernel.transpose()).cwiseAbs().maxCoeff() < 1e-12);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(kernel);
  RC_ASSERT(solver.eigenvalues().minCoeff() > -1e-9);
}

TEST(Kernel, RefusesOptionsOutOfRange) {
  EXPECT_TRUE(Kernel::create({}));
  EXPECT_FALSE(Kernel::create({.spline_weight = -0.1}));
  EXPECT_FALSE(Kernel::create({.gauss_weight = kNan}));
  EXPECT_FALSE(Kernel::create({.laplace_weight = kInf}));
  EXPECT_FALSE(Kernel::create({.spline_weight = 0.0, .gauss_weight = 0.0, .laplace_weight = 0.0}));
  EXPECT_FALSE(Kernel::create({.gauss_rate = 0.0}));
  EXPECT_FALSE(Kernel::create({.laplace_rate = -1.0}));
  EXPECT_FALSE(Kernel::create({.laplace_rate = kInf}));
  EXPECT_EQ(Kernel::create({.gauss_rate = kNan}).error().code, core::ErrorCode::kInvalidOptions);
}

}  // namespace
}  // namespace waylode::learn
