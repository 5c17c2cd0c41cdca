// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/core/fix.hpp"

#include <gtest/gtest.h>

namespace waylode::core {
namespace {

TEST(Fix, StartsWithoutAPosition) {
  const Fix fix;
  EXPECT_EQ(fix.state, FixState::kUnknown);
  EXPECT_FALSE(fix.belief);
}

TEST(Fix, NamesItsStatesAsTheContractDoes) {
  EXPECT_STREQ(to_string(FixState::kOk), "ok");
  EXPECT_STREQ(to_string(FixState::kLowConfidence), "low_confidence");
  EXPECT_STREQ(to_string(FixState::kUnknown), "unknown");
  EXPECT_STREQ(to_string(FixState::kOutside), "outside");
}

TEST(Fix, DiffersWhenAnyPartDiffers) {
  const Fix fix{
      device_time_from_ms(5), FixState::kOk, Belief{FloorId{1}, 0.9, Vector2(2.0, 3.0)}, {}};
  Fix other = fix;
  EXPECT_EQ(other, fix);
  other.belief->covariance_m2(0, 1) = 0.5;
  EXPECT_NE(other, fix);
  other = fix;
  other.provenance.last_scan = device_time_from_ms(4);
  EXPECT_NE(other, fix);
}

}  // namespace
}  // namespace waylode::core
