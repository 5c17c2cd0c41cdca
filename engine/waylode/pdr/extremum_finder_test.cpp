// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/extremum_finder.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace waylode::pdr {
namespace {

struct Found {
  int index;
  double value;
  bool is_peak;
  bool operator==(const Found&) const = default;
};

std::vector<Found> extremes_of(const std::vector<double>& values) {
  ExtremumFinder finder;
  std::vector<Found> found;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto extremum =
        finder.add(core::device_time_from_ms(static_cast<std::int64_t>(i)), values[i]);
    if (!extremum) continue;
    found.push_back({static_cast<int>(extremum->time.time_since_epoch().count() / 1'000'000),
                     extremum->value, extremum->is_peak});
  }
  return found;
}

TEST(ExtremumFinder, TellsPeaksAndTroughsInTurn) {
  EXPECT_EQ(extremes_of({0.0, 2.0, 1.0, -3.0, -1.0, 4.0, 3.0}),
            (std::vector<Found>{{1, 2.0, true}, {3, -3.0, false}, {5, 4.0, true}}));
}

TEST(ExtremumFinder, CountsAPlateauOnce) {
  EXPECT_EQ(extremes_of({0.0, 2.0, 2.0, 2.0, 1.0, 1.0, 5.0}),
            (std::vector<Found>{{1, 2.0, true}, {4, 1.0, false}}));
}

TEST(ExtremumFinder, PassesOverALedgeOnASlope) {
  EXPECT_TRUE(extremes_of({0.0, 1.0, 1.0, 2.0, 2.0, 3.0}).empty());
  EXPECT_TRUE(extremes_of({3.0, 1.0, 1.0, -2.0}).empty());
}

TEST(ExtremumFinder, FindsNothingInConstantOrShortInput) {
  EXPECT_TRUE(extremes_of({}).empty());
  EXPECT_TRUE(extremes_of({1.5}).empty());
  EXPECT_TRUE(extremes_of({1.5, 2.5}).empty());
  EXPECT_TRUE(extremes_of({1.5, 1.5, 1.5, 1.5}).empty());
}

}  // namespace
}  // namespace waylode::pdr
