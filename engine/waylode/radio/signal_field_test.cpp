// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/signal_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "waylode/radio/testing/surveyed_map.hpp"

namespace waylode::radio {
namespace {

using core::FloorId;
using core::TransmitterId;
using core::Vector2;
using testing::map_of;
using testing::query_of;
using testing::Surveyed;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

SignalField field_of(const site::RadioMap& map, const SignalField::Options& options = {}) {
  return SignalField::create(map, options).value();
}

/// Two groups of fingerprints 40 m apart: transmitter 1 at the left one, 2 at the right one, 3 at
/// both.
std::vector<Surveyed> two_ends() {
  std::vector<Surveyed> survey;
  for (int i = 0; i < 10; ++i) {
    survey.push_back({0, Vector2(0.3 * i, 0.0), {-55.0F, 0.0F, -70.0F}});
    survey.push_back({0, Vector2(40.0 + 0.3 * i, 0.0), {0.0F, -60.0F, -62.0F}});
  }
  return survey;
}

TEST(SignalField, ExpectsWhatOneTransmitterWasHeardWith) {
  // All at one place, so that law and kernel mean agree: the level itself; one scan in four misses.
  std::vector<Surveyed> survey(30, {0, Vector2(5.0, 3.0), {-61.0F, -80.0F}});
  for (int i = 0; i < 10; ++i) survey.push_back({0, Vector2(5.0, 3.0), {0.0F, -80.0F}});
  const auto storage = map_of(survey);
  const auto field = field_of(storage.view(), {.margin_m = 4.0, .prior_weight = 1e-3});
  const auto signal = field.expected(TransmitterId::wifi(1), FloorId{0}, Vector2(5.1, 2.9));
  ASSERT_TRUE(signal);
  EXPECT_NEAR(signal->mean_dbm, -61.0, 0.26);
  EXPECT_NEAR(signal->heard_ratio, 0.75, 1.0 / 255.0);
  EXPECT_NEAR(signal->sigma_db, 6.0, 0.06);  // Never below min_sigma_db.
}

TEST(SignalField, IsTheDenseModelWorkedOutPlaceByPlace) {
  const auto storage = map_of(two_ends());
  const SignalField::Options options{.effective_transmitters = 1.5};
  const auto field = field_of(storage.view(), options);
  const std::vector<float> heard = {-57.0F, 0.0F, -66.0F};
  const auto raster = field.likelihood(query_of(heard), FloorId{0});
  ASSERT_FALSE(raster.empty());
  const double s = options.surprise_ratio;
  for (std::size_t node = 0; node < raster.log_likelihood.size(); ++node) {
    const Vector2 place_m = raster.node_at(node / raster.columns, node % raster.columns);
    double sum = 0.0;
    for (std::size_t t = 0; t < 3; ++t) {
      const auto signal = field.expected(TransmitterId::wifi(t + 1), FloorId{0}, place_m);
      const double p = signal ? signal->heard_ratio : s;
      if (heard[t] == 0.0F) {
        sum += std::log(1.0 - p) - std::log(1.0 - s);
        continue;
      }
      double density = s / 80.0;
      if (signal) {
        const double off = (static_cast<double>(heard[t]) - signal->mean_dbm) / signal->sigma_db;
        density += (1.0 - s) * std::exp(-0.5 * off * off) /
                   (std::sqrt(2.0 * std::numbers::pi) * signal->sigma_db);
      } else {
        density = 1.0 / 80.0;
      }
      sum += std::log(p * density);
    }
    EXPECT_NEAR(raster.log_likelihood[node], sum * 1.5 / 2.0, 2e-4);
  }
}

TEST(SignalField, TakesSilenceAsEvidence) {
  // Transmitter 3 alone, as loud as between the ends: only the silence of 1 and 2 is left to tell.
  const auto storage = map_of(two_ends());
  const auto field = field_of(storage.view());
  const auto both = field.likelihood(query_of({-55.0F, 0.0F, -70.0F}), FloorId{0});
  EXPECT_GT(both.at({1.0, 0.0}), both.at({41.0, 0.0}) + 3.0);
  const auto silent = field.likelihood(query_of({0.0F, -60.0F, -66.0F}), FloorId{0});
  EXPECT_GT(silent.at({41.0, 0.0}), silent.at({1.0, 0.0}) + 3.0);
}

TEST(SignalField, HearsNothingInThePhonesSilenceOfAKind) {
  // As two_ends, and a beacon at the left: a phone that hears no Bluetooth at all is not thereby on
  // the right.
  site::RadioMapBuilder with;
  for (const Surveyed& surveyed : two_ends()) {
    site::FingerprintRecord record;
    record.x_m = static_cast<float>(surveyed.position_m.x());
    std::vector<site::MapReading> readings = {{TransmitterId::wifi(3), surveyed.rssi_dbm[2], 0.0F}};
    if (record.x_m < 20.0F) readings.push_back({TransmitterId::bluetooth(9), -60.0F, 0.0F});
    with.add(record, readings);
  }
  site::RadioMapBuilder without;
  for (const Surveyed& surveyed : two_ends()) {
    site::FingerprintRecord record;
    record.x_m = static_cast<float>(surveyed.position_m.x());
    without.add(record, {{TransmitterId::wifi(3), surveyed.rssi_dbm[2], 0.0F}});
  }
  const auto with_storage = with.build();
  const auto without_storage = without.build();
  const Query query = query_of({0.0F, 0.0F, -70.0F});
  EXPECT_EQ(field_of(with_storage.view()).likelihood(query, FloorId{0}),
            field_of(without_storage.view()).likelihood(query, FloorId{0}));
}

TEST(SignalField, DoubtsMoreTheFartherFromTheSurvey) {
  const auto storage = map_of(std::vector<Surveyed>(20, {0, Vector2(0.0, 0.0), {-50.0F}}));
  const auto field = field_of(storage.view(), {.margin_m = 30.0});
  double last_sigma_db = 0.0;
  double last_mean_dbm = 0.0;
  for (const double x_m : {0.0, 6.0, 12.0, 18.0}) {
    const auto signal = field.expected(TransmitterId::wifi(1), FloorId{0}, Vector2(x_m, 0.0));
    ASSERT_TRUE(signal);
    EXPECT_GE(signal->sigma_db, last_sigma_db);
    EXPECT_LT(signal->mean_dbm, last_mean_dbm);
    last_sigma_db = signal->sigma_db;
    last_mean_dbm = signal->mean_dbm;
  }
  EXPECT_GT(last_sigma_db, 4.0);
}

TEST(SignalField, TrustsAnOldReadingLess) {
  const auto storage = map_of(two_ends());
  const auto field = field_of(storage.view(), {.effective_transmitters = 1e6});
  const auto contrast = [&](float age_s) {
    Query query = query_of({-55.0F});
    query.readings[0].age_s = age_s;
    const auto raster = field.likelihood(query, FloorId{0});
    return raster.at({1.0, 0.0}) - raster.at({41.0, 0.0});
  };
  EXPECT_FLOAT_EQ(static_cast<float>(contrast(0.2F)), static_cast<float>(contrast(1.0F)));
  EXPECT_LT(contrast(4.0F), contrast(1.0F));
}

TEST(SignalField, SaysNothingOfWhatItDoesNotKnow) {
  const auto storage = map_of(two_ends());
  const auto field = field_of(storage.view());
  EXPECT_TRUE(field.likelihood(query_of({-55.0F}), FloorId{3}).empty());
  EXPECT_TRUE(field.likelihood(query_of({0.0F, 0.0F, 0.0F, 0.0F, -50.0F}), FloorId{0}).empty());
  EXPECT_TRUE(field.likelihood(query_of({}), FloorId{0}).empty());
  EXPECT_TRUE(field.likelihood(query_of({kNan}), FloorId{0}).empty());
  EXPECT_FALSE(field.expected(TransmitterId::wifi(1), FloorId{0}, Vector2(1e9, 0.0)));
  EXPECT_FALSE(field.geometry(FloorId{1}));
}

TEST(SignalField, PassesOverReadingsThatAreNotFinite) {
  const auto storage = map_of(two_ends());
  const auto field = field_of(storage.view());
  EXPECT_EQ(field.likelihood(query_of({-55.0F, kNan}), FloorId{0}),
            field.likelihood(query_of({-55.0F}), FloorId{0}));
}

TEST(SignalField, IsEmptyForAMapWithoutPlaces) {
  const auto empty = map_of({});
  EXPECT_TRUE(field_of(empty.view()).likelihood(query_of({-50.0F}), FloorId{0}).empty());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto nowhere = map_of({{0, Vector2(nan, 0.0), {-50.0F}}});
  EXPECT_TRUE(field_of(nowhere.view()).likelihood(query_of({-50.0F}), FloorId{0}).empty());
}

TEST(SignalField, RefusesOptionsOutOfRange) {
  using Options = SignalField::Options;
  EXPECT_TRUE(Options{}.validate());
  for (const Options& bad :
       {Options{.node_m = 0.0}, Options{.margin_m = -1.0}, Options{.kernel_m = 0.0},
        Options{.fade_m = 0.0}, Options{.prior_weight = 0.0}, Options{.prior_sigma_db = 1.0},
        Options{.hearing_scale_db = 0.0}, Options{.surprise_ratio = 0.0},
        Options{.effective_transmitters = 0.0}, Options{.age_decay_per_s = 1.1}}) {
    EXPECT_FALSE(bad.validate());
  }
  const auto storage = map_of(two_ends());
  EXPECT_FALSE(SignalField::create(storage.view(), {.node_m = 0.1}));
}

}  // namespace
}  // namespace waylode::radio
