// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/magnetic/step_field.hpp"

#include <gtest/gtest.h>

namespace waylode::magnetic {
namespace {

using core::device_time_from_seconds;

TEST(StepField, AveragesWhatWasFeltDuringTheStep) {
  StepField field;
  for (int i = 1; i <= 20; ++i) {
    field.add(device_time_from_seconds(0.1 * i), {static_cast<double>(i), -2.0 * i});
  }
  // After 0.5 s and up to 1.0 s: readings 6 to 10.
  const auto mean_ut = field.mean_ut(device_time_from_seconds(0.5), device_time_from_seconds(1.0));
  ASSERT_TRUE(mean_ut);
  EXPECT_DOUBLE_EQ(mean_ut->x(), 8.0);
  EXPECT_DOUBLE_EQ(mean_ut->y(), -16.0);
}

TEST(StepField, HasNoMeanOfNothing) {
  StepField field;
  EXPECT_FALSE(field.mean_ut(device_time_from_seconds(0.0), device_time_from_seconds(9.0)));
  field.add(device_time_from_seconds(1.0), {20.0, -40.0});
  EXPECT_FALSE(field.mean_ut(device_time_from_seconds(1.0), device_time_from_seconds(9.0)));
  EXPECT_TRUE(field.mean_ut(device_time_from_seconds(0.9), device_time_from_seconds(1.0)));
}

TEST(StepField, ForgetsWhatNoStepWillAskFor) {
  StepField field;
  field.add(device_time_from_seconds(1.0), {20.0, -40.0});
  field.add(device_time_from_seconds(7.0), {30.0, -40.0});
  EXPECT_FALSE(field.mean_ut(device_time_from_seconds(0.5), device_time_from_seconds(1.5)));
}

}  // namespace
}  // namespace waylode::magnetic
