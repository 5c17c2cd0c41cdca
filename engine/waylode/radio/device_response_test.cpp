// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/device_response.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace waylode::radio {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<ResponseResidual> louder_by(double offset_db, std::size_t count) {
  std::vector<ResponseResidual> residuals;
  for (std::size_t i = 0; i < count; ++i) {
    const double expected_dbm = -50.0 - 3.0 * static_cast<double>(i);
    residuals.push_back({expected_dbm + offset_db, expected_dbm, 4.0});
  }
  return residuals;
}

TEST(DeviceResponse, IsTheKalmanUpdateWorkedOutByHand) {
  DeviceResponse response({.prior_sigma_db = 6.0, .scan_sigma_db = 2.0, .drift_db = 0.0});
  EXPECT_DOUBLE_EQ(response.offset_db(), 0.0);
  EXPECT_DOUBLE_EQ(response.sigma_db(), 6.0);
  response.update(louder_by(8.0, 8));
  // Scan variance 4^2 / 8 + 2^2 = 6: gain 36 / 42.
  EXPECT_NEAR(response.offset_db(), 8.0 * 6.0 / 7.0, 1e-12);
  EXPECT_NEAR(response.sigma_db(), std::sqrt(36.0 / 7.0), 1e-12);
}

TEST(DeviceResponse, FindsAPhoneThatHearsMoreOrLess) {
  for (const double offset_db : {8.0, -8.0, 0.0}) {
    DeviceResponse response({});
    for (int scan = 0; scan < 30; ++scan) response.update(louder_by(offset_db, 20));
    EXPECT_NEAR(response.offset_db(), offset_db, 0.2);
    EXPECT_LT(response.sigma_db(), 1.0);
  }
}

TEST(DeviceResponse, IsHardlyMovedByAFewWildReadings) {
  std::vector<ResponseResidual> residuals = louder_by(5.0, 18);
  residuals.push_back({-20.0, -90.0, 4.0});
  residuals.push_back({-25.0, -95.0, 4.0});
  DeviceResponse response({});
  for (int scan = 0; scan < 30; ++scan) response.update(residuals);
  // Each pulls as one of 1.5 sigmas: 2 * 6 dB over 18 readings.
  EXPECT_NEAR(response.offset_db(), 5.0 + 12.0 / 18.0, 0.2);
}

TEST(DeviceResponse, PassesOverWhatSaysNothing) {
  DeviceResponse response({});
  response.update({});
  response.update(louder_by(8.0, 4));
  response.update(
      std::vector<ResponseResidual>(9, {.rssi_dbm = kNan, .expected_dbm = -60.0, .sigma_db = 4.0}));
  response.update(std::vector<ResponseResidual>(
      9, {.rssi_dbm = -50.0, .expected_dbm = -60.0, .sigma_db = 0.0}));
  response.update(std::vector<ResponseResidual>(
      9, {.rssi_dbm = -50.0, .expected_dbm = -kInfinity, .sigma_db = 4.0}));
  EXPECT_DOUBLE_EQ(response.offset_db(), 0.0);
  EXPECT_DOUBLE_EQ(response.sigma_db(), 6.0);
}

TEST(DeviceResponse, GrowsUncertainAgainWithDriftButNeverBeyondThePrior) {
  DeviceResponse response({.prior_sigma_db = 3.0, .scan_sigma_db = 50.0, .drift_db = 20.0});
  for (int scan = 0; scan < 5; ++scan) {
    response.update(louder_by(1.0, 9));
    EXPECT_LT(response.sigma_db(), 3.0);
  }
}

TEST(DeviceResponse, TakesWhatIsSureOfTheOffsetFromEveryReading) {
  DeviceResponse response({.drift_db = 0.0, .feigned_db = 2.5});
  response.update(louder_by(7.0, 16));
  Query query;
  query.readings = {{core::TransmitterId::wifi(1), -60.0F, 0.5F},
                    {core::TransmitterId::wifi(2), -71.5F, 2.5F}};
  const Query applied = response.applied(query);
  ASSERT_EQ(applied.readings.size(), 2U);
  EXPECT_NEAR(applied.readings[0].rssi_dbm, -60.0 - (7.0 * 36.0 / 41.0 - 2.5), 1e-4);
  EXPECT_NEAR(applied.readings[1].rssi_dbm, -71.5 - (7.0 * 36.0 / 41.0 - 2.5), 1e-4);
  EXPECT_FLOAT_EQ(applied.readings[1].age_s, 2.5F);
}

TEST(DeviceResponse, LeavesReadingsAloneWithinWhatMayBeFeigned) {
  DeviceResponse response({});
  for (int scan = 0; scan < 9; ++scan) response.update(louder_by(-2.6, 12));
  const Query query{{}, {}, {{core::TransmitterId::wifi(1), -60.0F, 0.5F}}};
  EXPECT_FLOAT_EQ(response.applied(query).readings[0].rssi_dbm, -60.0F);
}

TEST(DeviceResponse, RefusesOptionsOutOfRange) {
  EXPECT_TRUE(DeviceResponse::Options{}.validate());
  EXPECT_FALSE((DeviceResponse::Options{.prior_sigma_db = 0.0}.validate()));
  EXPECT_FALSE((DeviceResponse::Options{.scan_sigma_db = kNan}.validate()));
  EXPECT_FALSE((DeviceResponse::Options{.drift_db = -0.1}.validate()));
  EXPECT_FALSE((DeviceResponse::Options{.min_readings = 0}.validate()));
}

}  // namespace
}  // namespace waylode::radio
