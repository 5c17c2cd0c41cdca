// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/compass_heading_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "waylode/core/angle.hpp"
#include "waylode/core/covariance.hpp"
#include "waylode/core/rng.hpp"

namespace waylode::pdr {
namespace {

using core::device_time_from_seconds;
using core::kPi;
using core::radians_from_degrees;
using core::Vector3;

constexpr double kHorizontal_ut = 31.0;
constexpr double kDown_ut = 38.0;

/// What a phone lying flat, its long axis along `heading_rad` from magnetic east, sees.
Vector3 flat_field(double heading_rad, double horizontal_ut = kHorizontal_ut,
                   double down_ut = kDown_ut) {
  // North along the long axis is H sin(heading); its right is a quarter turn clockwise of it.
  return {-horizontal_ut * std::cos(heading_rad), horizontal_ut * std::sin(heading_rad), -down_ut};
}

class Phone {
 public:
  explicit Phone(const CompassHeadingFilter::Options& options) : filter(options) {}

  void gyroscope(double time_s, double rate_radps) {
    filter.add(sample::GyroscopeSample{device_time_from_seconds(time_s), {0.0, 0.0, rate_radps}},
               Vector3::UnitZ());
  }
  void compass(double time_s, const Vector3& field_ut) {
    filter.add(sample::MagnetometerSample{device_time_from_seconds(time_s), field_ut, 3},
               Vector3::UnitZ());
  }
  double off_rad(double heading_rad) const {
    return core::wrap_angle(*filter.heading_rad() - heading_rad);
  }

  CompassHeadingFilter filter;
};

TEST(CompassHeadingFilter, StartsAtTheCompass) {
  for (const double heading_rad : {-3.0, -1.2, 0.0, 0.7, 2.9}) {
    Phone phone({});
    EXPECT_FALSE(phone.filter.heading_rad());
    phone.compass(0.0, flat_field(heading_rad));
    EXPECT_NEAR(phone.off_rad(heading_rad), 0.0, 1e-12);
    EXPECT_NEAR(phone.filter.covariance()(0, 0), 0.35 * 0.35, 1e-12);
  }
}

TEST(CompassHeadingFilter, TurnsWithTheGyroscopeCounterClockwise) {
  Phone phone({});
  phone.compass(0.0, flat_field(0.4));
  for (int i = 0; i <= 100; ++i) phone.gyroscope(0.02 * i, 0.9);
  EXPECT_NEAR(phone.off_rad(0.4 + 0.9 * 2.0), 0.0, 1e-9);
}

TEST(CompassHeadingFilter, CountsADeclinationToTheEastOff) {
  // Magnetic north 10 degrees east of true north: a phone along magnetic east heads 10 degrees
  // south of true east.
  Phone phone({.declination_rad = radians_from_degrees(10.0)});
  phone.compass(0.0, flat_field(0.0));
  EXPECT_NEAR(phone.off_rad(radians_from_degrees(-10.0)), 0.0, 1e-12);
}

TEST(CompassHeadingFilter, LearnsTheGyroscopesBias) {
  Phone phone({});
  constexpr double kBias_radps = 0.012;
  for (int i = 0; i < 50 * 600; ++i) {
    phone.gyroscope(0.02 * i, kBias_radps);
    if (i % 5 == 0) phone.compass(0.02 * i, flat_field(kPi));
  }
  EXPECT_NEAR(phone.filter.bias_radps(), kBias_radps, 0.002);
  EXPECT_NEAR(phone.off_rad(kPi), 0.0, 0.1);
}

TEST(CompassHeadingFilter, DoubtsAFieldThatIsNotTheEarths) {
  const auto pull_rad = [](double horizontal_ut, double down_ut) {
    Phone phone({.field_ut = std::hypot(kHorizontal_ut, kDown_ut),
                 .dip_rad = std::atan2(kDown_ut, kHorizontal_ut)});
    phone.compass(0.0, flat_field(0.0));
    for (int i = 1; i < 100; ++i) phone.compass(0.1 * i, flat_field(0.4, horizontal_ut, down_ut));
    return phone.off_rad(0.0);
  };
  // No motion: 99 headings of inflated variance against the first.
  const auto expected_rad = [](double inflation) {
    const double alike = std::exp(-0.1);
    const double weight = 99.0 * (1.0 - alike) / (1.0 + alike) / inflation;
    return 0.4 * weight / (1.0 + weight);
  };
  const double strength = 0.4 * std::hypot(kHorizontal_ut, kDown_ut) / 3.0;
  const double dip =
      (std::atan2(kDown_ut, kHorizontal_ut) - std::atan2(kHorizontal_ut, kDown_ut)) / 0.1;
  EXPECT_NEAR(pull_rad(kHorizontal_ut, kDown_ut), expected_rad(1.0), 1e-3);
  EXPECT_NEAR(pull_rad(1.4 * kHorizontal_ut, 1.4 * kDown_ut),
              expected_rad(1.0 + strength * strength), 1e-3);
  EXPECT_NEAR(pull_rad(kDown_ut, kHorizontal_ut), expected_rad(1.0 + dip * dip), 1e-3);
}

TEST(CompassHeadingFilter, HalvesItsTrustAtTheTolerance) {
  // One correction each: with no correlation, gain = P / (P + R) at P = R0, R = R0 or 2 R0.
  const auto gain = [](double scale) {
    const double field_ut = std::hypot(kHorizontal_ut, kDown_ut);
    Phone phone({.correlation_s = 0.0,
                 .field_ut = field_ut,
                 .dip_rad = std::atan2(kDown_ut, kHorizontal_ut)});
    phone.compass(0.0, flat_field(0.0));
    phone.compass(0.2, flat_field(0.3, scale * kHorizontal_ut, scale * kDown_ut));
    return phone.off_rad(0.0) / 0.3;
  };
  EXPECT_NEAR(gain(1.0), 1.0 / 2.0, 1e-9);
  EXPECT_NEAR(gain(1.0 + 3.0 / std::hypot(kHorizontal_ut, kDown_ut)), 1.0 / 3.0, 1e-9);
}

TEST(CompassHeadingFilter, CountsAlikeErringHeadingsAsFew) {
  const auto gain = [](double correlation_s) {
    Phone phone({.correlation_s = correlation_s});
    phone.compass(0.0, flat_field(0.0));
    phone.compass(0.5, flat_field(0.3));
    return phone.off_rad(0.0) / 0.3;
  };
  const double alike = std::exp(-0.5 / 2.0);
  EXPECT_NEAR(gain(0.0), 0.5, 1e-9);
  EXPECT_NEAR(gain(2.0), 1.0 / (1.0 + (1.0 + alike) / (1.0 - alike)), 1e-9);
}

TEST(CompassHeadingFilter, PassesOverAHeadingBeyondTheGate) {
  Phone phone({.correlation_s = 0.0});
  phone.compass(0.0, flat_field(0.0));
  const double gate_rad = 3.0 * std::sqrt(2.0) * 0.35;
  phone.compass(0.2, flat_field(1.02 * gate_rad));
  EXPECT_EQ(phone.off_rad(0.0), 0.0);
  phone.compass(0.4, flat_field(0.98 * gate_rad));
  EXPECT_GT(phone.off_rad(0.0), 0.5);
}

TEST(CompassHeadingFilter, StartsAfreshAfterNothingButRefusals) {
  Phone phone({});
  phone.compass(0.0, flat_field(0.0));
  int i = 0;
  for (; i < 95; ++i) phone.compass(0.2 + 0.1 * i, flat_field(3.0));
  EXPECT_NEAR(phone.off_rad(0.0), 0.0, 1e-9);
  for (; i < 110; ++i) phone.compass(0.2 + 0.1 * i, flat_field(3.0));
  EXPECT_NEAR(phone.off_rad(3.0), 0.0, 0.01);
}

TEST(CompassHeadingFilter, CorrectsAcrossTheWrap) {
  Phone phone({.correlation_s = 0.0});
  phone.compass(0.0, flat_field(kPi - 0.1));
  phone.compass(0.2, flat_field(-kPi + 0.1));
  EXPECT_NEAR(phone.off_rad(kPi), 0.0, 1e-9);
}

TEST(CompassHeadingFilter, TakesACalibrationIntoAccount) {
  MagnetometerCalibration calibration;
  calibration.hard_iron_ut = {40.0, -25.0, 10.0};
  Phone phone({});
  phone.filter.set_calibration(calibration);
  phone.compass(0.0, flat_field(1.1) + calibration.hard_iron_ut);
  EXPECT_NEAR(phone.off_rad(1.1), 0.0, 1e-12);
}

TEST(CompassHeadingFilter, PassesOverWhatIsNoNumberAndTimesThatRepeat) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  Phone phone({});
  phone.compass(0.0, {kNan, 1.0, 2.0});
  phone.compass(0.0, Vector3::Zero());
  EXPECT_FALSE(phone.filter.heading_rad());
  phone.compass(1.0, flat_field(0.5));
  phone.gyroscope(1.0, 0.3);
  phone.gyroscope(1.0, 0.3);
  phone.gyroscope(1.1, kNan);
  phone.compass(1.0, flat_field(0.9));
  phone.gyroscope(60.0, 0.3);  // A hole is not bridged.
  EXPECT_NEAR(phone.off_rad(0.5), 0.0, 1e-12);
}

// The compass errs as the filter is told: sigma, correlated over a second. The squared error in
// units of its covariance then has mean 2.
TEST(CompassHeadingFilter, IsConsistent) {
  constexpr int kRuns = 150;
  constexpr double kRate_hz = 25.0;
  CompassHeadingFilter::Options options;
  options.gate_sigmas = 6.0;  // Lest it cuts the tails that the model has.
  double nees = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    core::Rng rng(900 + static_cast<std::uint64_t>(run));
    Phone phone(options);
    double heading_rad = rng.uniform(-kPi, kPi);
    double bias_radps = options.initial_bias_sigma_radps * rng.normal();
    double compass_error_rad = options.compass_sigma_rad * rng.normal();
    const double dt_s = 1.0 / kRate_hz;
    const double alike = std::exp(-dt_s / options.correlation_s);
    for (int i = 0; i < static_cast<int>(60.0 * kRate_hz); ++i) {
      const double time_s = dt_s * i;
      const double turn_radps = 0.5 * std::sin(0.3 * time_s + run);
      if (i > 0) {
        heading_rad += turn_radps * dt_s;
        bias_radps += options.bias_walk_radps_per_sqrt_s * std::sqrt(dt_s) * rng.normal();
        compass_error_rad = alike * compass_error_rad + options.compass_sigma_rad *
                                                            std::sqrt(1.0 - alike * alike) *
                                                            rng.normal();
        const double noise_radps =
            options.gyro_noise_rad_per_sqrt_s / std::sqrt(dt_s) * rng.normal();
        phone.gyroscope(time_s, turn_radps + bias_radps + noise_radps);
      }
      if (i == 0) phone.gyroscope(time_s, 0.0);
      phone.compass(time_s, flat_field(heading_rad + compass_error_rad));
    }
    const core::Vector2 error(phone.off_rad(heading_rad), phone.filter.bias_radps() - bias_radps);
    nees += core::squared_mahalanobis(error, phone.filter.covariance()) / kRuns;
  }
  // Chi-square with 300 degrees of freedom over 150, 99 %: 2 +- 2.58 sqrt(600) / 150.
  EXPECT_NEAR(nees, 2.0, 2.58 * std::sqrt(600.0) / 150.0);
}

TEST(CompassHeadingFilter, RefusesOptionsOutOfRange) {
  using Options = CompassHeadingFilter::Options;
  EXPECT_TRUE(Options{}.validate());
  for (const double value : {-0.1, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(Options{.gyro_noise_rad_per_sqrt_s = value}.validate());
    EXPECT_FALSE(Options{.initial_bias_sigma_radps = value}.validate());
    EXPECT_FALSE(Options{.bias_walk_radps_per_sqrt_s = value}.validate());
    EXPECT_FALSE(Options{.compass_interval_s = value}.validate());
    EXPECT_FALSE(Options{.compass_sigma_rad = value}.validate());
    EXPECT_FALSE(Options{.correlation_s = value}.validate());
    EXPECT_FALSE(Options{.field_ut = value}.validate());
    EXPECT_FALSE(Options{.field_tolerance_ut = value}.validate());
    EXPECT_FALSE(Options{.dip_tolerance_rad = value}.validate());
    EXPECT_FALSE(Options{.gate_sigmas = value}.validate());
    EXPECT_FALSE(Options{.lost_after_s = value}.validate());
  }
  EXPECT_FALSE(Options{.dip_rad = 2.0}.validate());
  EXPECT_FALSE(Options{.declination_rad = 4.0}.validate());
}

}  // namespace
}  // namespace waylode::pdr
