// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/sample/sample.hpp"

#include <gtest/gtest.h>

namespace waylode::sample {
namespace {

TEST(Sample, IsNamedAfterItsKind) {
  EXPECT_STREQ(kind_of(AccelerometerSample{}), "accelerometer");
  EXPECT_STREQ(kind_of(GyroscopeSample{}), "gyroscope");
  EXPECT_STREQ(kind_of(MagnetometerSample{}), "magnetometer");
  EXPECT_STREQ(kind_of(UncalibratedAccelerometerSample{}), "uncalibrated_accelerometer");
  EXPECT_STREQ(kind_of(UncalibratedGyroscopeSample{}), "uncalibrated_gyroscope");
  EXPECT_STREQ(kind_of(UncalibratedMagnetometerSample{}), "uncalibrated_magnetometer");
  EXPECT_STREQ(kind_of(RotationSample{}), "rotation");
  EXPECT_STREQ(kind_of(BarometerSample{}), "barometer");
  EXPECT_STREQ(kind_of(WifiScan{}), "wifi_scan");
  EXPECT_STREQ(kind_of(BleReading{}), "ble");
  EXPECT_STREQ(kind_of(GnssSample{}), "gnss");
  EXPECT_STREQ(kind_of(WaypointSample{}), "waypoint");
}

TEST(Sample, TellsItsTimeWhateverItsKind) {
  const DeviceTime time = core::device_time_from_ms(1234);
  EXPECT_EQ(time_of(BarometerSample{time, 1013.25}), time);
  EXPECT_EQ(time_of(WifiScan{time, {}}), time);
}

TEST(Sample, StartsWithoutMotion) {
  EXPECT_EQ(AccelerometerSample{}.specific_force_mps2, Vector3::Zero());
  EXPECT_EQ(UncalibratedGyroscopeSample{}.bias_radps, Vector3::Zero());
  EXPECT_EQ(RotationSample{}.enu_from_device.coeffs(), core::Quaternion::Identity().coeffs());
}

TEST(Sample, ComparesByValue) {
  const RotationSample level{core::device_time_from_ms(1), core::Quaternion(1.0, 0.0, 0.0, 0.0)};
  const RotationSample turned{core::device_time_from_ms(1), core::Quaternion(0.0, 0.0, 0.0, 1.0)};
  EXPECT_EQ(Sample(level), Sample(level));
  EXPECT_NE(Sample(level), Sample(turned));
  EXPECT_NE(Sample(BarometerSample{}), Sample(GnssSample{}));
}

}  // namespace
}  // namespace waylode::sample
