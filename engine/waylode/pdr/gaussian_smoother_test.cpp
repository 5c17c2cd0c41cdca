// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/gaussian_smoother.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace waylode::pdr {
namespace {

using core::device_time_from_seconds;

TEST(GaussianSmoother, WeighsByTheGaussianAboutTheMiddleOfTheWindow) {
  // A unit pulse at 0.5 s in zeros each 0.02 s, sigma 0.2 / 6.
  GaussianSmoother smoother(0.2);
  double weight_sum = 0.0;
  for (int j = -5; j <= 5; ++j) weight_sum += std::exp(-0.5 * std::pow(j * 0.02 * 6.0 / 0.2, 2));
  for (int i = 0; i <= 50; ++i) {
    const auto smooth = smoother.add(device_time_from_seconds(0.02 * i), i == 25 ? 1.0 : 0.0);
    ASSERT_EQ(smooth.has_value(), i >= 10);
    if (!smooth) continue;
    EXPECT_EQ(smooth->time, device_time_from_seconds(0.02 * (i - 5)));
    const int away = i - 5 - 25;
    const double weight =
        std::abs(away) > 5 ? 0.0 : std::exp(-0.5 * std::pow(away * 0.02 * 6.0 / 0.2, 2));
    EXPECT_NEAR(smooth->value, weight / weight_sum, 1e-12);
  }
}

TEST(GaussianSmoother, PassesSlowWavesByTheGaussiansTransfer) {
  // A Gaussian of sigma passes exp(-(2 pi f sigma)^2 / 2); cut at three sigma it passes a bit more.
  constexpr double kFrequency_hz = 1.7;
  GaussianSmoother smoother(0.3);
  const double expected =
      std::exp(-0.5 * std::pow(2.0 * std::numbers::pi * kFrequency_hz * 0.05, 2));
  double largest = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double time_s = 0.005 * i;
    const auto smooth = smoother.add(device_time_from_seconds(time_s),
                                     std::sin(2.0 * std::numbers::pi * kFrequency_hz * time_s));
    if (smooth) largest = std::max(largest, smooth->value);
  }
  EXPECT_NEAR(largest, expected, 0.005);
}

TEST(GaussianSmoother, KeepsAConstantAtAnUnsteadyRate) {
  GaussianSmoother smoother(0.2);
  double time_s = 0.0;
  for (int i = 0; i < 200; ++i) {
    time_s += 0.003 + 0.05 * (i % 7 == 0 ? 1.0 : 0.2);
    const auto smooth = smoother.add(device_time_from_seconds(time_s), -4.25);
    if (smooth) {
      EXPECT_NEAR(smooth->value, -4.25, 1e-12);
    }
  }
}

TEST(GaussianSmoother, TellsTheNewestWhereAllElseIsFar) {
  GaussianSmoother smoother(0.2);
  smoother.add(device_time_from_seconds(0.0), 1.0);
  const auto smooth = smoother.add(device_time_from_seconds(1000.0), 3.0);
  ASSERT_TRUE(smooth);
  EXPECT_TRUE(std::isfinite(smooth->value));
  EXPECT_NEAR(smooth->value, 3.0, 1e-9);
}

}  // namespace
}  // namespace waylode::pdr
