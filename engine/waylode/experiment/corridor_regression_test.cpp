// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/experiment/corridor_regression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace waylode::experiment {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const CorridorRegression::Method& method_of(const CorridorRegression& study,
                                            const std::string& name) {
  const auto found = std::ranges::find(study.methods, name, &CorridorRegression::Method::name);
  EXPECT_NE(found, study.methods.end()) << name;
  return *found;
}

double largest(const std::vector<Unit>& units) {
  double most = 0.0;
  for (const Unit& unit : units) most = std::max(most, *std::ranges::max_element(unit));
  return most;
}

TEST(CorridorRegression, SurveysAMetreGridOfTheCorridor) {
  const auto draw = draw_corridor({}, 3);
  ASSERT_EQ(draw.survey_m.rows(), 48);
  ASSERT_EQ(draw.survey_dbm.cols(), 8);
  EXPECT_NEAR(draw.survey_m.col(0).minCoeff(), 16.15 - draw.survey_m.col(0).maxCoeff(), 1e-12);
  EXPECT_NEAR(draw.survey_m.col(1).minCoeff(), 3.7 - draw.survey_m.col(1).maxCoeff(), 1e-12);
  for (int i = 0; i < 48; ++i) {
    double nearest_m = 99.0;
    for (int j = 0; j < 48; ++j) {
      if (j != i) {
        nearest_m = std::min(nearest_m, (draw.survey_m.row(i) - draw.survey_m.row(j)).norm());
      }
    }
    EXPECT_NEAR(nearest_m, 1.0, 1e-12);
  }
  EXPECT_GE(draw.query_m.minCoeff(), 0.0);
  EXPECT_LT(draw.query_m.col(0).maxCoeff(), 16.15);
  EXPECT_LT(draw.query_m.col(1).maxCoeff(), 3.7);
}

TEST(CorridorRegression, HearsTheAccessPointsByTheirDistance) {
  CorridorRegression::Options options;
  options.noise_sigma_db = 0.0;
  const auto draw = draw_corridor(options, 3);
  // Place (0.575, 0.85) from the points at (2.075, 0) and (14.075, 3.7).
  EXPECT_NEAR(draw.survey_dbm(0, 0), -35.0 - 20.0 * std::log10(std::hypot(1.5, 0.85) / 2.0), 1e-9);
  EXPECT_NEAR(draw.survey_dbm(0, 7), -35.0 - 20.0 * std::log10(std::hypot(13.5, 2.85) / 2.0), 1e-9);
}

TEST(CorridorRegression, AveragesTheScansOfAReferencePlace) {
  CorridorRegression::Options quiet;
  quiet.noise_sigma_db = 0.0;
  CorridorRegression::Options options;
  options.scans = 16;
  const auto error_db = [&](std::uint64_t seed) -> Eigen::MatrixXd {
    return draw_corridor(options, seed).survey_dbm - draw_corridor(quiet, seed).survey_dbm;
  };
  double sum_db2 = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) sum_db2 += error_db(seed).squaredNorm();
  EXPECT_NEAR(std::sqrt(sum_db2 / (20.0 * 48.0 * 8.0)), 2.0 / 4.0, 0.02);
}

TEST(CorridorRegression, FindsPlacesToTheGridWithoutNoise) {
  CorridorRegression::Options options;
  options.noise_sigma_db = 0.0;
  options.draws = 2;
  const auto study = compare_positioning(options);
  ASSERT_TRUE(study) << study.error().message;
  EXPECT_LT(largest(method_of(*study, "maximum likelihood, true map").errors_m), 0.4);
  EXPECT_LT(largest(method_of(*study, "5 nearest, weighted").errors_m), 1.7);
}

TEST(CorridorRegression, ReachesThePapersShareAndMean) {
  CorridorRegression::Options options;
  options.draws = 40;
  const auto outcome = corridor_regression_outcome(options);
  ASSERT_TRUE(outcome) << outcome.error().message;
  std::size_t judged = 0;
  for (const Figure& figure : outcome->figures) {
    if (!figure.bar) continue;
    ++judged;
    EXPECT_TRUE(*figure.reached()) << figure.what << ' ' << figure.ours.value;
  }
  EXPECT_EQ(judged, 2U);
}

TEST(CorridorRegression, NoMethodBeatsTheTrueMap) {
  CorridorRegression::Options options;
  options.draws = 5;
  const auto study = compare_positioning(options);
  ASSERT_TRUE(study);
  const double bound_m =
      bootstrap(method_of(*study, "maximum likelihood, true map").errors_m, mean_of).value;
  for (const auto& method : study->methods) {
    EXPECT_GE(bootstrap(method.errors_m, mean_of).value, bound_m) << method.name;
  }
}

TEST(CorridorRegression, KeepsSigmaWhereThereIsOne) {
  CorridorRegression::Options options;
  options.draws = 2;
  options.queries = 30;
  const auto study = compare_positioning(options);
  ASSERT_TRUE(study);
  for (const auto& method : study->methods) {
    ASSERT_EQ(method.errors_m.size(), 2U);
    EXPECT_EQ(method.errors_m.front().size(), 30U);
    const bool has_sigma = method.name.starts_with("RVR");
    EXPECT_EQ(method.sigmas_m.size(), has_sigma ? 2U : 0U);
    EXPECT_EQ(method.errors_in_sigmas.size(), method.sigmas_m.size());
    if (has_sigma) {
      EXPECT_EQ(method.sigmas_m.front().size(), 60U);
    }
  }
}

TEST(CorridorRegression, RefusesOptionsOutOfRange) {
  using Options = CorridorRegression::Options;
  for (const Options& options : {Options{.reference_m = 0.0}, Options{.reference_dbm = kNan},
                                 Options{.exponent = -2.0}, Options{.noise_sigma_db = kNan},
                                 Options{.scans = 0}, Options{.queries = 0}, Options{.draws = 0}}) {
    const auto refused = corridor_regression_outcome(options);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, core::ErrorCode::kInvalidOptions);
  }
}

}  // namespace
}  // namespace waylode::experiment
