// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "waylode/core/covariance.hpp"
#include "waylode/fusion/planar_tracker.hpp"
#include "waylode/fusion/testing/planar_model.hpp"

namespace waylode::fusion {
namespace {

using core::Matrix2;
using core::Vector2;
using testing::at_s;
using testing::ModelWalk;

constexpr int kRuns = 200;
constexpr int kStepsPerScan = 6;

/// Walks of the model: after every scan `look` sees the tracker and the true state.
template <typename Look>
void run_walks(const PlanarTracker::Options& options, int scans, const Look& look) {
  for (int run = 0; run < kRuns; ++run) {
    ModelWalk walk(options, 1000 + static_cast<std::uint64_t>(run));
    PlanarTracker tracker(options, /*keep_history=*/true);
    tracker.start(at_s(0.0), Vector2::Zero(), options.start_sigma_m);
    for (int scan = 0; scan < scans; ++scan) {
      for (int i = 0; i < kStepsPerScan; ++i) tracker.add(walk.step());
      const PlanarMeasurement measurement = walk.scan();
      tracker.add(measurement);
      look(scan, tracker, measurement, walk.truth());
    }
  }
}

TEST(PlanarTrackerConsistency, StatesItsPositionErrorHonestly) {
  constexpr int kScans = 40;
  std::vector<double> sum(kScans);
  run_walks(testing::gaussian_options(), kScans,
            [&](int scan, const PlanarTracker& tracker, const auto&, const PlanarVector& truth) {
              const Vector2 error_m = tracker.state().position_m() - truth.head<2>();
              sum[static_cast<std::size_t>(scan)] +=
                  core::squared_mahalanobis(error_m, tracker.state().position_covariance_m2());
            });
  // 200 runs of two degrees of freedom: chi-square with 400, divided by 200, 99.9 % within.
  for (const std::size_t scan : {0U, 1U, 5U, 12U, 25U, 39U}) {
    EXPECT_GT(sum[scan] / kRuns, 1.567) << scan;
    EXPECT_LT(sum[scan] / kRuns, 2.499) << scan;
  }
}

TEST(PlanarTrackerConsistency, StatesTheErrorOfItsWholeStateHonestly) {
  constexpr int kScans = 30;
  double sum = 0.0;
  run_walks(testing::gaussian_options(), kScans,
            [&](int scan, const PlanarTracker& tracker, const auto&, const PlanarVector& truth) {
              if (scan + 1 < kScans) return;
              const PlanarVector error = tracker.state().mean - truth;
              sum += error.dot(tracker.state().covariance.ldlt().solve(error));
            });
  // Six degrees of freedom: chi-square with 1200, divided by 200, 99.9 % within.
  EXPECT_GT(sum / kRuns, 5.226);
  EXPECT_LT(sum / kRuns, 6.841);
}

TEST(PlanarTrackerConsistency, ExpectsInnovationsAsLargeAsTheyAre) {
  constexpr int kScans = 30;
  double sum = 0.0;
  run_walks(testing::gaussian_options(), kScans,
            [&](int, const PlanarTracker& tracker, const PlanarMeasurement& scan, const auto&) {
              const PlanarState& before = tracker.history().back().predicted;
              Eigen::Matrix<double, 2, 6> model = Eigen::Matrix<double, 2, 6>::Zero();
              model.leftCols<2>().setIdentity();
              model.rightCols<2>().setIdentity();
              const Matrix2 expected_m2 =
                  model * before.covariance * model.transpose() + scan.covariance_m2;
              sum += core::squared_mahalanobis(scan.position_m - model * before.mean, expected_m2);
            });
  // 6000 innovations of two degrees of freedom each: mean 2, sigma 2 / sqrt(6000), 99.9 % within.
  EXPECT_NEAR(sum / (kRuns * kScans), 2.0, 3.29 * 2.0 / std::sqrt(6000.0));
}

}  // namespace
}  // namespace waylode::fusion
