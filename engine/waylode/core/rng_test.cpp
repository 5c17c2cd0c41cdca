// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/core/rng.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace waylode::core {
namespace {

TEST(Rng, DrawsFromTheStandardsMersenneTwister) {
  // [rand.predef]: the 10000th value of a default-constructed mt19937_64, whose seed is 5489.
  constexpr std::uint64_t kTenThousandth = 9981545732273789042ULL;
  Rng rng(5489);
  for (int i = 1; i < 10'000; ++i) rng.uniform();
  EXPECT_EQ(rng.uniform(), static_cast<double>(kTenThousandth >> 11U) * 0x1.0p-53);
}

TEST(Rng, RepeatsItselfForTheSameSeedOnly) {
  Rng first(7);
  Rng same(7);
  Rng other(8);
  int differences = 0;
  for (int i = 0; i < 100; ++i) {
    const double value = first.normal();
    EXPECT_EQ(value, same.normal());
    if (value != other.normal()) ++differences;
  }
  EXPECT_GT(differences, 90);
}

TEST(Rng, FillsTheUnitIntervalEvenly) {
  // Mean 1/2, variance 1/12; bounds are five standard errors.
  Rng rng(11);
  constexpr int kCount = 100'000;
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double value = rng.uniform();
    ASSERT_GE(value, 0.0);
    ASSERT_LT(value, 1.0);
    sum += value;
    sum_of_squares += value * value;
  }
  const double mean = sum / kCount;
  EXPECT_NEAR(mean, 0.5, 5.0 * std::sqrt(1.0 / 12.0 / kCount));
  EXPECT_NEAR(sum_of_squares / kCount - mean * mean, 1.0 / 12.0,
              5.0 * std::sqrt(1.0 / 180.0 / kCount));
}

TEST(Rng, KeepsUniformValuesBetweenTheirBounds) {
  Rng rng(12);
  for (int i = 0; i < 1000; ++i) {
    const double value = rng.uniform(-3.0, -1.0);
    ASSERT_GE(value, -3.0);
    ASSERT_LT(value, -1.0);
  }
}

TEST(Rng, DrawsEveryIntegerEquallyOften) {
  Rng rng(13);
  constexpr std::size_t kBuckets = 7;
  constexpr int kCount = 70'000;
  std::array<int, kBuckets> counts{};
  for (int i = 0; i < kCount; ++i) ++counts.at(rng.below(kBuckets));
  double chi_square = 0.0;
  for (const int count : counts) chi_square += std::pow(count - 10'000.0, 2) / 10'000.0;
  EXPECT_LT(chi_square, 22.46);  // The 99.9 % quantile for six degrees of freedom.
}

TEST(Rng, StaysBelowItsCountAtTheEnds) {
  Rng rng(14);
  constexpr std::uint64_t kMoreThanHalf = (1ULL << 63U) + 1ULL;
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(rng.below(1), 0U);
    EXPECT_LT(rng.below(kMoreThanHalf), kMoreThanHalf);
  }
}

TEST(Rng, HasTheMomentsOfTheNormalDistribution) {
  // Mean 0, variance 1, third moment 0, fourth 3; bounds are five standard errors.
  Rng rng(15);
  constexpr int kCount = 200'000;
  std::array<double, 5> moments{};
  int within_one_sigma = 0;
  for (int i = 0; i < kCount; ++i) {
    const double value = rng.normal();
    for (std::size_t power = 1; power < moments.size(); ++power) {
      moments.at(power) += std::pow(value, static_cast<double>(power)) / kCount;
    }
    if (std::abs(value) < 1.0) ++within_one_sigma;
  }
  const double standard_error = 1.0 / std::sqrt(kCount);
  EXPECT_NEAR(moments[1], 0.0, 5.0 * standard_error);
  EXPECT_NEAR(moments[2], 1.0, 5.0 * std::sqrt(2.0) * standard_error);
  EXPECT_NEAR(moments[3], 0.0, 5.0 * std::sqrt(15.0) * standard_error);
  EXPECT_NEAR(moments[4], 3.0, 5.0 * std::sqrt(96.0) * standard_error);
  EXPECT_NEAR(static_cast<double>(within_one_sigma) / kCount, 0.682689,
              5.0 * 0.4655 * standard_error);
}

TEST(Rng, DoesNotCorrelateNeighbouringNormals) {
  // The polar method makes them in pairs; the lag-one correlation has standard error 1/sqrt(n).
  Rng rng(16);
  constexpr int kCount = 100'000;
  double products = 0.0;
  double previous = rng.normal();
  for (int i = 0; i < kCount; ++i) {
    const double value = rng.normal();
    products += previous * value;
    previous = value;
  }
  EXPECT_NEAR(products / kCount, 0.0, 5.0 / std::sqrt(kCount));
}

TEST(Rng, ShiftsAndScalesNormals) {
  Rng plain(17);
  Rng scaled(17);
  for (int i = 0; i < 10; ++i)
    EXPECT_DOUBLE_EQ(scaled.normal(-60.0, 4.0), -60.0 + 4.0 * plain.normal());
}

TEST(Rng, ForksAPartThatDoesNotDisturbTheRest) {
  Rng busy(18);
  Rng idle(18);
  Rng busy_part = busy.fork();
  Rng idle_part = idle.fork();
  for (int i = 0; i < 50; ++i) busy_part.normal();
  EXPECT_EQ(busy.uniform(), idle.uniform());
  EXPECT_NE(idle_part.uniform(), Rng(18).uniform());
}

}  // namespace
}  // namespace waylode::core
