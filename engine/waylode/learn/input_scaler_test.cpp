// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/learn/input_scaler.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace waylode::learn {
namespace {

using Eigen::MatrixXd;

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(InputScaler, MapsTheExtremesOfAllColumnsToZeroAndOne) {
  const MatrixXd inputs{{-90.0, -50.0}, {-40.0, -65.0}};
  const auto scaler = InputScaler::learn(inputs, {});
  ASSERT_TRUE(scaler);
  EXPECT_TRUE(scaler->scale(inputs).isApprox(MatrixXd{{0.0, 0.8}, {1.0, 0.5}}, 1e-14));
}

TEST(InputScaler, ClipsWhatLiesBeyond) {
  const auto scaler = InputScaler::from_range(-90.0, 50.0, {.clip_low = -0.1, .clip_high = 1.3});
  ASSERT_TRUE(scaler);
  const MatrixXd scaled = scaler->scale(MatrixXd{{-200.0, -92.5, -30.0, 70.0, kInf, -kInf}});
  EXPECT_TRUE(scaled.isApprox(MatrixXd{{-0.1, -0.05, 1.2, 1.3, 1.3, -0.1}}, 1e-14)) << scaled;
  EXPECT_TRUE(std::isnan(scaler->scale(MatrixXd{{kNan}})(0, 0)));
}

TEST(InputScaler, MapsEqualInputsToZero) {
  const auto scaler = InputScaler::learn(MatrixXd::Constant(3, 2, -70.0), {});
  ASSERT_TRUE(scaler);
  EXPECT_EQ(scaler->scale(MatrixXd{{-70.0, -69.5}}), (MatrixXd{{0.0, 0.5}}));
}

TEST(InputScaler, RefusesInputsItCannotLearnFrom) {
  EXPECT_FALSE(InputScaler::learn(MatrixXd(0, 3), {}));
  EXPECT_FALSE(InputScaler::learn(MatrixXd{{1.0, kNan}}, {}));
  EXPECT_FALSE(InputScaler::learn(MatrixXd{{1.0, kInf}}, {}));
  constexpr double kHuge = std::numeric_limits<double>::max();
  EXPECT_FALSE(InputScaler::learn(MatrixXd{{-kHuge, kHuge}}, {}));
  EXPECT_EQ(InputScaler::learn(MatrixXd(3, 0), {}).error().code, core::ErrorCode::kInvalidArgument);
}

TEST(InputScaler, RefusesARangeThatVanishes) {
  EXPECT_FALSE(InputScaler::from_range(1.0, 0.0, {}));
  EXPECT_FALSE(InputScaler::from_range(1.0, -2.0, {}));
  EXPECT_FALSE(InputScaler::from_range(1.0, 1e-320, {}));
  EXPECT_FALSE(InputScaler::from_range(kNan, 1.0, {}));
  EXPECT_FALSE(InputScaler::from_range(0.0, kInf, {}));
}

TEST(InputScaler, RefusesOptionsOutOfRange) {
  EXPECT_FALSE(InputScaler::from_range(0.0, 1.0, {.clip_low = 0.1}));
  EXPECT_FALSE(InputScaler::from_range(0.0, 1.0, {.clip_high = 0.9}));
  EXPECT_FALSE(InputScaler::from_range(0.0, 1.0, {.clip_low = kNan}));
  EXPECT_EQ(InputScaler::from_range(0.0, 1.0, {.clip_high = kInf}).error().code,
            core::ErrorCode::kInvalidOptions);
}

}  // namespace
}  // namespace waylode::learn
