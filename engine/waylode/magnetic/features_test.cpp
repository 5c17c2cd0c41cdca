// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/magnetic/features.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "waylode/core/angle.hpp"

namespace waylode::magnetic {
namespace {

using core::Vector3;

const double kNan = std::numeric_limits<double>::quiet_NaN();
const double kInfinity = std::numeric_limits<double>::infinity();

TEST(FieldFeatures, AreThoseOfAKnownField) {
  const auto features = field_features(Vector3(3.0, 4.0, -12.0));
  ASSERT_TRUE(features);
  EXPECT_NEAR(features->total_ut, 13.0, 1e-12);
  EXPECT_NEAR(features->horizontal_ut, 5.0, 1e-12);
  EXPECT_NEAR(features->declination_rad.value(), std::asin(0.8), 1e-12);
  EXPECT_NEAR(features->inclination_rad.value(), -std::asin(12.0 / 13.0), 1e-12);
}

TEST(FieldFeatures, TellDirectionsInAllQuadrants) {
  EXPECT_NEAR(field_features(Vector3(-1.0, 1.0, 0.0))->declination_rad.value(), 0.75 * core::kPi,
              1e-12);
  EXPECT_NEAR(field_features(Vector3(-1.0, -1.0, 0.0))->declination_rad.value(), -0.75 * core::kPi,
              1e-12);
}

TEST(FieldFeatures, HaveNoDirectionWhereThereIsNone) {
  const auto upright = field_features(Vector3(0.0, 0.0, 45.0));
  ASSERT_TRUE(upright);
  EXPECT_FALSE(upright->declination_rad);
  EXPECT_NEAR(upright->inclination_rad.value(), core::kPi / 2.0, 1e-12);
  const auto none = field_features(Vector3::Zero());
  ASSERT_TRUE(none);
  EXPECT_EQ(none->total_ut, 0.0);
  EXPECT_FALSE(none->declination_rad);
  EXPECT_FALSE(none->inclination_rad);
}

TEST(FieldFeatures, OfNoFieldAreNone) {
  EXPECT_FALSE(field_features(Vector3(kNan, 1.0, 1.0)));
  EXPECT_FALSE(field_features(Vector3(1.0, -kInfinity, 1.0)));
}

TEST(LevelField, OfAPhoneOnATableIsItsOwn) {
  EXPECT_EQ(level_field(Vector3(3.0, -4.0, -40.0), Vector3(0.0, 0.0, 2.5)),
            (LevelField{5.0, -40.0}));
}

TEST(LevelField, OfAPhoneUprightTakesItsLengthForUp) {
  const auto level = level_field(Vector3(6.0, -40.0, 8.0), Vector3(0.0, 1.0, 0.0));
  ASSERT_TRUE(level);
  EXPECT_NEAR(level->horizontal_ut, 10.0, 1e-12);
  EXPECT_NEAR(level->vertical_ut, -40.0, 1e-12);
}

TEST(LevelField, NeedsAFieldAndAnUp) {
  const Vector3 field(20.0, 5.0, -40.0);
  EXPECT_FALSE(level_field(field, Vector3::Zero()));
  EXPECT_FALSE(level_field(field, Vector3(0.0, kNan, 1.0)));
  EXPECT_FALSE(level_field(field, Vector3(0.0, kInfinity, 1.0)));
  EXPECT_FALSE(level_field(Vector3(kNan, 5.0, -40.0), Vector3::UnitZ()));
  EXPECT_EQ(level_field(Vector3::Zero(), Vector3::UnitZ()), (LevelField{0.0, 0.0}));
}

RC_GTEST_PROP(LevelFieldProperty, DoesNotDependOnPoseOrFacing, ()) {
  const auto draw = [](int limit) { return 0.01 * *rc::gen::inRange(-limit, limit); };
  const Vector3 enu_ut(draw(6000), draw(6000), draw(6000));
  const Vector3 axis(draw(100), draw(100), draw(100));
  RC_PRE(axis.norm() > 0.05);
  const core::Quaternion device_from_enu(Eigen::AngleAxisd(draw(314), axis.normalized()));
  const auto level = level_field(device_from_enu * enu_ut, device_from_enu * Vector3::UnitZ());
  RC_ASSERT(level.has_value());
  RC_ASSERT(std::abs(level->horizontal_ut - enu_ut.head<2>().norm()) < 1e-9);
  RC_ASSERT(std::abs(level->vertical_ut - enu_ut.z()) < 1e-9);
}

}  // namespace
}  // namespace waylode::magnetic
