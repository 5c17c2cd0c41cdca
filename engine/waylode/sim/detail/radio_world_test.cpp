// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/sim/detail/radio_world.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "waylode/sim/ascii_building.hpp"

namespace waylode::sim::detail {
namespace {

using core::Vector2;

constexpr core::FloorId kGround{0};
/// Transmitters hang at 2.6 m, phones are carried at 1.1 m.
constexpr double kUp_m = 1.5;

Building building_of(const char* text) { return *parse_ascii_building(text, "drawing"); }

TEST(RadioWorld, FallsByLogDistanceInTheOpen) {
  const Building building =
      building_of("floor F1 level 0 elevation_m 0\nA.............................\n");
  RadioOptions options;
  options.shadowing_sigma_db = 0.0;
  options.path_loss_exponent = 2.7;
  options.wifi_power_dbm = -38.0;
  options.band_5ghz_loss_db = 7.0;
  const RadioWorld world(building, options, 5);
  ASSERT_EQ(world.emitters().size(), 2U);
  for (const double x_m : {3.5, 11.5, 27.5}) {
    const double expected_dbm = -38.0 - 27.0 * std::log10(std::hypot(x_m - 0.5, kUp_m));
    EXPECT_NEAR(world.mean_rssi_dbm(0, kGround, {x_m, 0.5}), expected_dbm, 1e-9);
    EXPECT_NEAR(world.mean_rssi_dbm(1, kGround, {x_m, 0.5}), expected_dbm - 7.0, 1e-9);
  }
}

TEST(RadioWorld, LosesPerWallUpToTheCapAndPerSlab) {
  const Building building = building_of(
      "floor F1 level 0 elevation_m 0\n"
      "..#..#..#..\n"
      "A.#..#..#..\n"
      "..#..#..#..\n"
      "floor F2 level 1 elevation_m 3\n"
      "...........\n"
      "...........\n"
      "...........\n");
  RadioOptions options;
  options.shadowing_sigma_db = 0.0;
  options.wall_loss_db = 5.0;
  options.wall_loss_cap_db = 12.0;
  options.floor_loss_db = 14.0;
  options.path_loss_exponent = 2.0;
  options.wifi_power_dbm = -40.0;
  const RadioWorld world(building, options, 5);
  const auto open_dbm = [](double along_m, double up_m) {
    return -40.0 - 20.0 * std::log10(std::hypot(along_m, up_m));
  };
  EXPECT_EQ(world.walls_crossed(kGround, {0.5, 1.5}, {10.4, 1.7}), 3);
  EXPECT_NEAR(world.mean_rssi_dbm(0, kGround, {4.5, 1.5}), open_dbm(4.0, kUp_m) - 5.0, 1e-9);
  EXPECT_NEAR(world.mean_rssi_dbm(0, kGround, {7.5, 1.5}), open_dbm(7.0, kUp_m) - 10.0, 1e-9);
  EXPECT_NEAR(world.mean_rssi_dbm(0, kGround, {9.5, 1.5}), open_dbm(9.0, kUp_m) - 12.0, 1e-9);
  EXPECT_NEAR(world.mean_rssi_dbm(0, core::FloorId{1}, {9.5, 1.5}),
              open_dbm(9.0, 3.0 - kUp_m) - 14.0, 1e-9);
}

TEST(RadioWorld, GivesEveryAddressItsOwnUniversalOne) {
  const Building building = building_of("floor F1 level 0 elevation_m 0\nA..B..c\n");
  const RadioWorld world(building, {}, 9);
  ASSERT_EQ(world.emitters().size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_FALSE(world.emitters()[i].id.locally_administered());
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(world.emitters()[i].id, world.emitters()[j].id);
  }
  EXPECT_EQ(world.emitters()[4].id.kind(), core::TransmitterId::Kind::kBluetooth);
}

double empirical_correlation(Correlation correlation, double range_m, double distance_m) {
  constexpr int kFields = 3000;
  double product = 0.0;
  double power = 0.0;
  for (int seed = 0; seed < kFields; ++seed) {
    const RandomField field(static_cast<std::uint64_t>(seed), correlation, range_m);
    const Vector2 here_m(2.0, -1.0);
    const double a = field.at(here_m);
    const double b = field.at(here_m + distance_m * Vector2(0.6, 0.8));
    product += a * b;
    power += 0.5 * (a * a + b * b);
  }
  EXPECT_NEAR(power / kFields, 1.0, 0.06);
  return product / power;
}

TEST(RandomField, CorrelatesByItsFormula) {
  // The standard error of a correlation over 3000 fields is below 0.02.
  EXPECT_NEAR(empirical_correlation(Correlation::kExponential, 3.0, 1.5), std::exp(-0.5), 0.06);
  EXPECT_NEAR(empirical_correlation(Correlation::kExponential, 3.0, 6.0), std::exp(-2.0), 0.06);
  EXPECT_NEAR(empirical_correlation(Correlation::kSquaredExponential, 2.5, 2.5), std::exp(-1.0),
              0.06);
}

}  // namespace
}  // namespace waylode::sim::detail
