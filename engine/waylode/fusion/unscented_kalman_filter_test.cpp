// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/unscented_kalman_filter.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "waylode/core/angle.hpp"
#include "waylode/core/rng.hpp"

namespace waylode::fusion {
namespace {

using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;
using Matrix2 = Eigen::Matrix2d;
using Matrix3 = Eigen::Matrix3d;
using Filter3 = UnscentedKalmanFilter<3>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <int Rows, int Columns>
Eigen::Matrix<double, Rows, Columns> random_matrix(core::Rng& rng, double size) {
  Eigen::Matrix<double, Rows, Columns> result;
  for (int i = 0; i < result.size(); ++i) result(i) = rng.normal(0.0, size);
  return result;
}

template <int Rows>
Eigen::Matrix<double, Rows, Rows> random_covariance(core::Rng& rng, double size) {
  const auto root = random_matrix<Rows, Rows>(rng, size);
  return root * root.transpose() +
         0.1 * size * size * Eigen::Matrix<double, Rows, Rows>::Identity();
}

template <int Rows>
bool is_positive_definite(const Eigen::Matrix<double, Rows, Rows>& matrix) {
  return (matrix - matrix.transpose()).norm() == 0.0 && matrix.llt().info() == Eigen::Success;
}

RC_GTEST_PROP(SigmaWeights, SumToOneForAnySpread, ()) {
  const int states = *rc::gen::inRange(1, 10);
  core::Rng rng(*rc::gen::arbitrary<std::uint32_t>());
  const SigmaSpread spread{rng.uniform(0.01, 1.0), 2.0, rng.uniform(-0.9, 5.0) * states};
  RC_ASSERT(spread.validate(states));
  const SigmaWeights weights = sigma_weights(spread, states);
  RC_ASSERT(std::abs(weights.mean_sum(states) - 1.0) < 1e-9 / (spread.alpha * spread.alpha));
}

TEST(SigmaWeights, AsPrintedSumToOneOnlyWhereLambdaIsOne) {
  // lambda (1 + n) / (n + lambda), three states.
  const auto sum = [](const SigmaSpread& spread) {
    return printed_sigma_weights(spread, 3).mean_sum(3);
  };
  EXPECT_NEAR(sum({1.0, 2.0, 1.0}), 1.0, 1e-12);
  EXPECT_NEAR(sum({1.0, 2.0, 0.0}), 0.0, 1e-12);
  EXPECT_NEAR(sum({1.0, 2.0, 2.0}), 1.6, 1e-12);
  EXPECT_NEAR(sum({1e-3, 2.0, 0.0}), -4e6, 10.0);
}

TEST(SigmaWeights, FollowTheUnscentedTransform) {
  const SigmaSpread spread{0.5, 2.0, 1.0};  // lambda = 0.25 * 4 - 3 = -2.
  EXPECT_NEAR(spread.lambda(3), -2.0, 1e-15);
  const SigmaWeights weights = sigma_weights(spread, 3);
  EXPECT_NEAR(weights.central_mean, -2.0, 1e-12);
  EXPECT_NEAR(weights.central_covariance, -2.0 + 1.0 - 0.25 + 2.0, 1e-12);
  EXPECT_NEAR(weights.other, 0.5, 1e-12);
}

TEST(SigmaWeights, RejectSpreadsThatMakeNoSense) {
  EXPECT_TRUE(SigmaSpread{}.validate(6));
  for (const SigmaSpread& bad :
       {SigmaSpread{0.0}, SigmaSpread{1.1}, SigmaSpread{-0.5}, SigmaSpread{kNan},
        SigmaSpread{1.0, 0.9}, SigmaSpread{1.0, kNan}, SigmaSpread{1.0, kInfinity},
        SigmaSpread{1.0, 2.0, -6.0}, SigmaSpread{1.0, 2.0, kNan}}) {
    const auto valid = bad.validate(6);
    ASSERT_FALSE(valid) << bad.alpha << " " << bad.beta << " " << bad.kappa;
    EXPECT_EQ(valid.error().code, core::ErrorCode::kInvalidOptions);
  }
}

/// The linear Kalman filter of the textbooks.
struct LinearFilter {
  Vector3 mean;
  Matrix3 covariance;

  void predict(const Matrix3& transition, const Matrix3& noise) {
    mean = transition * mean;
    covariance = (transition * covariance * transition.transpose() + noise).eval();
  }
  double update(const Vector2& measured, const Eigen::Matrix<double, 2, 3>& model,
                const Matrix2& noise) {
    const Matrix2 expected = model * covariance * model.transpose() + noise;
    const Eigen::Matrix<double, 3, 2> gain = covariance * model.transpose() * expected.inverse();
    const Vector2 innovation = measured - model * mean;
    mean += gain * innovation;
    covariance = ((Matrix3::Identity() - gain * model) * covariance).eval();
    return innovation.dot(expected.inverse() * innovation);
  }
};

void expect_linear_filter(std::uint64_t seed, const SigmaSpread& spread, double tolerance) {
  core::Rng rng(seed);
  LinearFilter expected{random_matrix<3, 1>(rng, 2.0), random_covariance<3>(rng, 1.5)};
  Filter3 filter(spread, expected.mean, expected.covariance);
  for (int i = 0; i < 15; ++i) {
    const Matrix3 transition = random_matrix<3, 3>(rng, 0.6);
    const Matrix3 noise = random_covariance<3>(rng, 0.5);
    expected.predict(transition, noise);
    ASSERT_TRUE(filter.predict([&](const Vector3& x) -> Vector3 { return transition * x; }, noise));
    const Eigen::Matrix<double, 2, 3> model = random_matrix<2, 3>(rng, 1.0);
    const Matrix2 measurement_noise = random_covariance<2>(rng, 0.7);
    const Vector2 measured = random_matrix<2, 1>(rng, 3.0);
    const double chi_square = expected.update(measured, model, measurement_noise);
    const auto update = filter.update<2>(
        measured, [&](const Vector3& x) -> Vector2 { return model * x; }, measurement_noise);
    ASSERT_TRUE(update);
    ASSERT_NEAR(update->normalized_innovation_squared, chi_square, tolerance * (1.0 + chi_square));
    ASSERT_EQ(update->noise_inflation, 1.0);
    ASSERT_LT((filter.mean() - expected.mean).norm(), tolerance) << i;
    ASSERT_LT((filter.covariance() - expected.covariance).norm(), tolerance) << i;
  }
}

RC_GTEST_PROP(UnscentedKalmanFilter, EqualsTheKalmanFilterWhereAllIsLinear, ()) {
  core::Rng rng(*rc::gen::arbitrary<std::uint32_t>());
  const SigmaSpread spread{rng.uniform(0.1, 1.0), rng.uniform(1.0, 3.0), rng.uniform(-2.5, 3.0)};
  expect_linear_filter(*rc::gen::arbitrary<std::uint32_t>(), spread, 1e-8);
}

TEST(UnscentedKalmanFilter, KeepsItsDigitsWithATinyAlpha) {
  expect_linear_filter(3, {1e-3, 2.0, 0.0}, 1e-8);
}

TEST(UnscentedKalmanFilter, FindsTheMomentsOfASquare) {
  // Of x^2 for x ~ N(3, 2^2): mean 9 + 4; variance 4 * 9 * 4 + 2 * 16. Noise 0.25 beside it.
  using Filter1 = UnscentedKalmanFilter<1>;
  for (const double alpha : {1.0, 0.3, 0.01}) {
    Filter1 filter({alpha, 2.0, 0.0}, Filter1::State(3.0), Filter1::Covariance(4.0));
    ASSERT_TRUE(filter.predict([](const Filter1::State& x) { return Filter1::State(x(0) * x(0)); },
                               Filter1::Covariance(0.25)));
    EXPECT_NEAR(filter.mean()(0), 13.0, 1e-8) << alpha;
    // alpha^2 s^4 from the points and (beta - alpha^2) s^4 from the central one: 2 s^4.
    EXPECT_NEAR(filter.covariance()(0), 144.0 + 32.0 + 0.25, 1e-6) << alpha;
  }
}

// A second implementation, from the printed equations as corrected, in loops over plain arrays.
namespace textbook {

constexpr int kN = 3;
using Vector = std::array<double, kN>;
using Matrix = std::array<Vector, kN>;

Matrix lower_root(const Matrix& a) {
  Matrix l{};
  for (int i = 0; i < kN; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = a[i][j];
      for (int k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
      l[i][j] = i == j ? std::sqrt(sum) : sum / l[j][j];
    }
  }
  return l;
}

struct Filter {
  double alpha, beta, kappa;
  Vector mean;
  Matrix covariance;

  std::vector<Vector> points() const {
    const double spanned = alpha * alpha * (kN + kappa);
    Matrix scaled = covariance;
    for (auto& row : scaled)
      for (double& value : row) value *= spanned;
    const Matrix root = lower_root(scaled);
    std::vector<Vector> result(2 * kN + 1, mean);
    for (int i = 0; i < kN; ++i) {
      for (int row = 0; row < kN; ++row) {
        result[1 + i][row] += root[row][i];
        result[1 + kN + i][row] -= root[row][i];
      }
    }
    return result;
  }
  double mean_weight(std::size_t i) const {
    const double spanned = alpha * alpha * (kN + kappa);
    return i == 0 ? (spanned - kN) / spanned : 0.5 / spanned;
  }
  double covariance_weight(std::size_t i) const {
    return mean_weight(i) + (i == 0 ? 1.0 - alpha * alpha + beta : 0.0);
  }

  template <typename Function>
  void predict(const Function& f, const Matrix& noise) {
    std::vector<Vector> moved = points();
    for (Vector& point : moved) point = f(point);
    mean = {};
    for (std::size_t i = 0; i < moved.size(); ++i)
      for (int row = 0; row < kN; ++row) mean[row] += mean_weight(i) * moved[i][row];
    covariance = noise;
    for (std::size_t i = 0; i < moved.size(); ++i)
      for (int row = 0; row < kN; ++row)
        for (int column = 0; column < kN; ++column)
          covariance[row][column] += covariance_weight(i) * (moved[i][row] - mean[row]) *
                                     (moved[i][column] - mean[column]);
  }

  /// A measurement of one number.
  template <typename Function>
  double update(double measured, const Function& h, double noise) {
    const std::vector<Vector> drawn = points();
    double expected = 0.0;
    for (std::size_t i = 0; i < drawn.size(); ++i) expected += mean_weight(i) * h(drawn[i]);
    double variance = noise;
    Vector cross{};
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const double off = h(drawn[i]) - expected;
      variance += covariance_weight(i) * off * off;
      for (int row = 0; row < kN; ++row)
        cross[row] += covariance_weight(i) * (drawn[i][row] - mean[row]) * off;
    }
    const double innovation = measured - expected;
    for (int row = 0; row < kN; ++row) {
      mean[row] += cross[row] / variance * innovation;
      for (int column = 0; column < kN; ++column)
        covariance[row][column] -= cross[row] * cross[column] / variance;
    }
    return innovation * innovation / variance;
  }
};

}  // namespace textbook

/// A step of 0.8 m that bends, in a state of x, y and heading; and the distance to a beacon.
template <typename Vector>
Vector bent_step(const Vector& x, double turn_rad) {
  Vector result = x;
  result[2] = x[2] + turn_rad;
  result[0] = x[0] + 0.8 * std::cos(result[2]);
  result[1] = x[1] + 0.8 * std::sin(result[2]) + 0.01 * x[0] * x[0];
  return result;
}

template <typename Vector>
double beacon_distance(const Vector& x) {
  return std::hypot(x[0] - 4.0, x[1] + 7.0);
}

TEST(UnscentedKalmanFilter, EqualsASecondImplementationOnCurvedFunctions) {
  for (const SigmaSpread& spread :
       {SigmaSpread{1.0, 2.0, 0.0}, SigmaSpread{0.6, 2.0, 1.5}, SigmaSpread{1.0, 1.0, -1.0}}) {
    core::Rng rng(17);
    Matrix3 covariance = Vector3(0.6, 0.4, 0.09).asDiagonal();
    covariance(0, 1) = covariance(1, 0) = 0.2;
    Filter3 filter(spread, Vector3(1.0, -2.0, 0.4), covariance);
    textbook::Filter expected{spread.alpha, spread.beta, spread.kappa, {1.0, -2.0, 0.4}, {}};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) expected.covariance[i][j] = covariance(i, j);
    const Matrix3 noise = Vector3(0.02, 0.03, 0.004).asDiagonal();
    const textbook::Matrix plain_noise{{{0.02, 0.0, 0.0}, {0.0, 0.03, 0.0}, {0.0, 0.0, 0.004}}};
    for (int step = 0; step < 40; ++step) {
      const double turn_rad = rng.uniform(-0.3, 0.3);
      ASSERT_TRUE(filter.predict([&](const Vector3& x) { return bent_step(x, turn_rad); }, noise));
      expected.predict([&](const textbook::Vector& x) { return bent_step(x, turn_rad); },
                       plain_noise);
      const double measured = beacon_distance(expected.mean) + rng.normal(0.0, 0.6);
      const auto update = filter.update<1>(
          Eigen::Matrix<double, 1, 1>(measured),
          [](const Vector3& x) { return Eigen::Matrix<double, 1, 1>(beacon_distance(x)); },
          Eigen::Matrix<double, 1, 1>(0.3));
      const double chi_square = expected.update(
          measured, [](const textbook::Vector& x) { return beacon_distance(x); }, 0.3);
      ASSERT_TRUE(update);
      ASSERT_NEAR(update->normalized_innovation_squared, chi_square, 1e-7) << step;
      for (int i = 0; i < 3; ++i) {
        ASSERT_NEAR(filter.mean()(i), expected.mean[i], 1e-7) << step;
        for (int j = 0; j < 3; ++j)
          ASSERT_NEAR(filter.covariance()(i, j), expected.covariance[i][j], 1e-7) << step;
      }
    }
  }
}

TEST(UnscentedKalmanFilter, FindsTheMeanAndWidthOfAStepWhoseHeadingIsDoubtful) {
  // A step of 5 m under a heading known to 0.3 rad; closed form: E[cos] = cos(m) exp(-s^2 / 2).
  Filter3 filter({1.0, 2.0, 0.0}, Vector3(0.0, 0.0, 0.5),
                 Matrix3(Vector3(0.01, 0.01, 0.09).asDiagonal()));
  ASSERT_TRUE(filter.predict(
      [](const Vector3& x) {
        return Vector3(x(0) + 5.0 * std::cos(x(2)), x(1) + 5.0 * std::sin(x(2)), x(2));
      },
      Matrix3(1e-6 * Matrix3::Identity())));
  const double shrunk = std::exp(-0.045);
  EXPECT_NEAR(filter.mean()(0), 5.0 * shrunk * std::cos(0.5), 0.01);
  EXPECT_NEAR(filter.mean()(1), 5.0 * shrunk * std::sin(0.5), 0.01);
  // A linearised filter would stay at 5 m.
  EXPECT_LT(filter.mean().head<2>().norm(), 4.8);
  // Across the way 25 sin^2 of N(0, 0.09): 12.5 (1 - exp(-0.18)), and the place's own 0.01.
  const Vector2 across(-std::sin(0.5), std::cos(0.5));
  const Matrix2 place = filter.covariance().topLeftCorner<2, 2>();
  EXPECT_NEAR(across.dot(place * across), 12.5 * (1.0 - std::exp(-0.18)) + 0.01, 0.2);
}

TEST(UnscentedKalmanFilter, WrapsAnglesThroughTheCallersResidual) {
  const auto wrapped = [](const Eigen::Matrix<double, 1, 1>& a,
                          const Eigen::Matrix<double, 1, 1>& b) {
    return Eigen::Matrix<double, 1, 1>(core::wrap_angle(a(0) - b(0)));
  };
  using Filter1 = UnscentedKalmanFilter<1>;
  const auto bearing = [](const Filter1::State& x) {
    return Eigen::Matrix<double, 1, 1>(core::wrap_angle(x(0)));
  };
  Filter1 filter({}, Filter1::State(3.1), Filter1::Covariance(0.04));
  const auto update = filter.update<1>(Eigen::Matrix<double, 1, 1>(-3.1), bearing,
                                       Eigen::Matrix<double, 1, 1>(0.04), kInfinity, wrapped);
  ASSERT_TRUE(update);
  // Half of the 0.083 rad between them.
  const double between_rad = 2.0 * core::kPi - 6.2;
  EXPECT_NEAR(filter.mean()(0), 3.1 + 0.5 * between_rad, 1e-9);
  EXPECT_NEAR(filter.covariance()(0), 0.02, 1e-9);
  EXPECT_NEAR(update->normalized_innovation_squared, between_rad * between_rad / 0.08, 1e-9);
  // Predicting across the seam keeps the spread.
  ASSERT_TRUE(filter.predict(
      [](const Filter1::State& x) { return Filter1::State(core::wrap_angle(x(0) + 0.02)); },
      Filter1::Covariance(0.0), wrapped));
  EXPECT_NEAR(filter.covariance()(0), 0.02, 1e-9);
}

TEST(UnscentedKalmanFilter, InflatesTheNoiseOfWhatIsBeyondTheGate) {
  using Filter1 = UnscentedKalmanFilter<1>;
  const auto itself = [](const Filter1::State& x) { return Eigen::Matrix<double, 1, 1>(x(0)); };
  Filter1 filter({}, Filter1::State(0.0), Filter1::Covariance(3.0));
  // Innovation 12, variance 3 + 1: chi-square 36. Gate 4: noise 9 times.
  const auto update = filter.update<1>(Eigen::Matrix<double, 1, 1>(12.0), itself,
                                       Eigen::Matrix<double, 1, 1>(1.0), 4.0);
  ASSERT_TRUE(update);
  EXPECT_NEAR(update->normalized_innovation_squared, 36.0, 1e-9);
  EXPECT_NEAR(update->noise_inflation, 9.0, 1e-9);
  EXPECT_NEAR(filter.mean()(0), 12.0 * 3.0 / (3.0 + 9.0), 1e-9);
  EXPECT_NEAR(filter.covariance()(0), 3.0 * 9.0 / 12.0, 1e-9);
}

TEST(UnscentedKalmanFilter, RefusesWhatIsNotFinite) {
  const Vector3 mean(1.0, 2.0, 3.0);
  Filter3 filter({}, mean, Matrix3::Identity());
  const auto place = [](const Vector3& x) -> Vector2 { return x.head<2>(); };
  for (const double bad : {kNan, kInfinity}) {
    EXPECT_FALSE(filter.update<2>(Vector2(bad, 0.0), place, Matrix2::Identity()));
    EXPECT_FALSE(filter.update<2>(Vector2(0.0, 0.0), place, Matrix2(bad * Matrix2::Identity())));
    EXPECT_FALSE(
        filter.predict([&](const Vector3& x) -> Vector3 { return bad * x; }, Matrix3::Zero()));
    EXPECT_FALSE(
        filter.predict([](const Vector3& x) { return x; }, Matrix3(bad * Matrix3::Identity())));
  }
  EXPECT_EQ(filter.mean(), mean);
  EXPECT_EQ(filter.covariance(), Matrix3::Identity());
}

RC_GTEST_PROP(UnscentedKalmanFilter, KeepsItsCovariancePositiveWhateverTheFunctions, ()) {
  core::Rng rng(*rc::gen::arbitrary<std::uint32_t>());
  const SigmaSpread spread{rng.uniform(0.001, 1.0), 2.0, rng.uniform(-2.9, 3.0)};
  Filter3 filter(spread, random_matrix<3, 1>(rng, 5.0), random_covariance<3>(rng, 3.0));
  for (int i = 0; i < 30; ++i) {
    const Matrix3 bend = random_matrix<3, 3>(rng, 1.0);
    filter.predict(
        [&](const Vector3& x) -> Vector3 {
          return (bend * x).array().sin() * 3.0 + 0.1 * x.array().square().min(100.0);
        },
        random_covariance<3>(rng, 0.1));
    RC_ASSERT(is_positive_definite<3>(filter.covariance()));
    const double noise = std::pow(10.0, rng.uniform(-6.0, 2.0));
    filter.update<2>(
        random_matrix<2, 1>(rng, 5.0),
        [&](const Vector3& x) -> Vector2 { return {std::cos(x(0)) * x(1), x(2) * x(2) + x(0)}; },
        Matrix2(noise * Matrix2::Identity()), rng.below(2) == 0 ? 4.0 : kInfinity);
    RC_ASSERT(is_positive_definite<3>(filter.covariance()));
    RC_ASSERT(filter.mean().allFinite());
  }
}

/// Walks drawn from the model of bent steps, a place measured every third one.
TEST(UnscentedKalmanFilter, StatesItsErrorHonestlyOnWalksOfItsModel) {
  constexpr int kRuns = 300;
  constexpr int kScans = 15;
  const Matrix3 noise = Vector3(0.01, 0.01, 0.0025).asDiagonal();
  const Matrix2 scan_noise = Vector2(2.25, 4.0).asDiagonal();
  const Vector3 prior_sigma(1.0, 1.5, 0.2);
  const auto place = [](const Vector3& x) -> Vector2 { return x.head<2>(); };
  double last_nees = 0.0;
  double nis = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    core::Rng rng(5000 + static_cast<std::uint64_t>(run));
    const auto drawn = [&](const Vector3& sigma) {
      return Vector3(rng.normal(0.0, sigma(0)), rng.normal(0.0, sigma(1)),
                     rng.normal(0.0, sigma(2)));
    };
    Vector3 truth = drawn(prior_sigma);
    Filter3 filter({}, Vector3::Zero(),
                   Matrix3(prior_sigma.array().square().matrix().asDiagonal()));
    for (int step = 0; step < 3 * kScans; ++step) {
      const auto walk = [&](const Vector3& x) { return bent_step(x, step % 9 == 0 ? 0.5 : 0.0); };
      truth = walk(truth) + drawn(Vector3(0.1, 0.1, 0.05));
      ASSERT_TRUE(filter.predict(walk, noise));
      if (step % 3 != 2) continue;
      const Vector2 scan = truth.head<2>() + Vector2(rng.normal(0.0, 1.5), rng.normal(0.0, 2.0));
      nis += filter.update<2>(scan, place, scan_noise)->normalized_innovation_squared;
    }
    const Vector3 error = filter.mean() - truth;
    last_nees += error.dot(filter.covariance().ldlt().solve(error));
  }
  // Three degrees of freedom, 300 runs: chi-square with 900, divided by 300, 99.9 % within
  // 3 +- 3.29 sqrt(2 * 3 / 300). Two degrees, 4500 innovations.
  EXPECT_NEAR(last_nees / kRuns, 3.0, 3.29 * std::sqrt(6.0 / kRuns));
  EXPECT_NEAR(nis / (kRuns * kScans), 2.0, 3.29 * std::sqrt(4.0 / (kRuns * kScans)));
}

}  // namespace
}  // namespace waylode::fusion
