// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/experiment/paper_rooms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <variant>

#include "waylode/sim/world.hpp"

namespace waylode::experiment {
namespace {

using core::Vector2;
using Levels = std::map<core::TransmitterId, double>;

constexpr double kUnheard_dbm = -100.0;

/// A reference point and its mean levels.
struct Place {
  Vector2 position_m;
  Levels levels_dbm;
};

double level(const Levels& levels, core::TransmitterId id) {
  const auto found = levels.find(id);
  return found == levels.end() ? kUnheard_dbm : found->second;
}

/// All transmitters of the room, unheard ones included.
std::set<core::TransmitterId> transmitters_of(const PaperRoom& room) {
  std::set<core::TransmitterId> ids;
  for (const sample::FingerprintRow& row : room.survey) {
    for (const sample::WifiReading& reading : row.readings) ids.insert(reading.transmitter);
  }
  return ids;
}

std::vector<Place> places_of(const PaperRoom& room) {
  const auto ids = transmitters_of(room);
  const std::size_t scans = room.instances_per_point * room.scans_per_instance;
  std::vector<Place> places;
  for (std::size_t i = 0; i < room.reference_points_m.size(); ++i) {
    Place place{room.reference_points_m[i], {}};
    for (const core::TransmitterId id : ids) place.levels_dbm[id] = 0.0;
    for (std::size_t j = i * scans; j < (i + 1) * scans; ++j) {
      Levels heard;
      for (const auto& reading : room.survey[j].readings) {
        heard[reading.transmitter] = static_cast<double>(reading.rssi_dbm);
      }
      for (auto& [id, sum_dbm] : place.levels_dbm) {
        sum_dbm += level(heard, id) / static_cast<double>(scans);
      }
    }
    places.push_back(std::move(place));
  }
  return places;
}

core::TransmitterId strongest(const Levels& levels) {
  return std::max_element(levels.begin(), levels.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

/// Plain weighted K = 4 over the whole map, or over the places with the same strongest transmitter.
Vector2 locate(const std::vector<Place>& places, const sample::WifiScan& scan, bool by_region) {
  Levels heard;
  for (const auto& [id, unused] : places.front().levels_dbm) heard[id] = kUnheard_dbm;
  for (const auto& reading : scan.readings) {
    heard[reading.transmitter] = static_cast<double>(reading.rssi_dbm);
  }
  std::vector<std::pair<double, const Place*>> nearest;
  for (const Place& place : places) {
    if (by_region && strongest(place.levels_dbm) != strongest(heard)) continue;
    double sum_db2 = 0.0;
    for (const auto& [id, dbm] : heard) sum_db2 += std::pow(dbm - level(place.levels_dbm, id), 2.0);
    nearest.emplace_back(std::sqrt(sum_db2), &place);
  }
  if (nearest.size() < 4) return locate(places, scan, false);
  std::sort(nearest.begin(), nearest.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  Vector2 sum_m = Vector2::Zero();
  double weights = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double weight = 1.0 / (nearest[i].first + 1e-3);
    sum_m += weight * nearest[i].second->position_m;
    weights += weight;
  }
  return sum_m / weights;
}

Vector2 truth_at(const sim::SimulatedRecording& walk, core::DeviceTime time) {
  const auto after = std::lower_bound(
      walk.truth.begin(), walk.truth.end(), time,
      [](const sim::TruthState& state, core::DeviceTime t) { return state.time < t; });
  return after == walk.truth.end() ? walk.truth.back().position_m : after->position_m;
}

/// Mean error of single scans over walks.
template <typename Make>
double wifi_error_m(Make&& make, int walks, bool by_region) {
  double sum_m = 0.0;
  std::size_t count = 0;
  for (int i = 0; i < walks; ++i) {
    const auto room = make(static_cast<std::uint64_t>(100 + i));
    EXPECT_TRUE(room) << core::to_string(room.error());
    const auto places = places_of(*room);
    for (const sample::Sample& sample : room->walk.samples) {
      const auto* scan = std::get_if<sample::WifiScan>(&sample);
      if (scan == nullptr) continue;
      sum_m += (locate(places, *scan, by_region) - truth_at(room->walk, scan->time)).norm();
      ++count;
    }
  }
  return sum_m / static_cast<double>(count);
}

// The bounds are wide: twelve walks have a standard error of some 0.1 m.

TEST(PaperRooms, AreAsHardByRadioAsWusCarPark) {
  const auto quiet = [](std::uint64_t seed) { return wu_room(WuPreset::kI, seed); };
  EXPECT_NEAR(wifi_error_m(quiet, 12, true), 1.37, 0.35);
  const auto ordinary = [](std::uint64_t seed) { return wu_room(WuPreset::kA, seed); };
  EXPECT_NEAR(wifi_error_m(ordinary, 12, true), 2.49, 0.6);
}

TEST(PaperRooms, AreAsHardByRadioAsZhaosSquare) {
  const auto harsh = [](std::uint64_t seed) { return zhao_square(ZhaoPreset::kHarsh, seed); };
  EXPECT_NEAR(wifi_error_m(harsh, 12, false), 2.31, 0.7);
  const auto normal = [](std::uint64_t seed) { return zhao_square(ZhaoPreset::kNormal, seed); };
  EXPECT_NEAR(wifi_error_m(normal, 12, false), 1.14, 0.4);
}

TEST(PaperRooms, AreAsHardByRadioAsZhousCorridor) {
  // Single scans are fresher than fixes held for three seconds, of which the figure is 2.6 m.
  const auto make = [](std::uint64_t seed) { return zhou_corridor(ZhouPreset::kA, seed); };
  const double error_m = wifi_error_m(make, 12, false);
  EXPECT_GT(error_m, 1.4);
  EXPECT_LT(error_m, 3.2);
}

TEST(PaperRooms, AreSurveyedAsThePapersSay) {
  const auto wu = *wu_room(WuPreset::kI, 3);
  EXPECT_EQ(wu.reference_points_m.size(), 256U);
  EXPECT_EQ(wu.survey.size(), 25600U);
  EXPECT_EQ(wu.site.radio_map().fingerprints.size(), 2560U);
  EXPECT_EQ(wu.site.radio_map().transmitters.size(), 3U);
  const auto zhou = *zhou_corridor(ZhouPreset::kA, 3);
  EXPECT_EQ(zhou.site.radio_map().transmitters.size(), 4U);
  EXPECT_EQ(zhou.start_scans.size(), 6U);
  EXPECT_EQ(zhou.magnetic_map.size(), 151U);
  EXPECT_NEAR(zhou.magnetic_map.back().position_m.x(), 30.0, 1e-9);
  const auto zhao = *zhao_square(ZhaoPreset::kHarsh, 3);
  EXPECT_EQ(zhao.reference_points_m.size(), 64U);
  EXPECT_EQ(zhao.site.radio_map().transmitters.size(), 6U);
  std::set<std::uint32_t> recordings;
  for (const auto& record : zhao.site.radio_map().fingerprints) recordings.insert(record.recording);
  EXPECT_EQ(recordings.size(), 640U);
}

TEST(PaperRooms, WalkTheRoutesOfThePapers) {
  const auto zhou = *zhou_corridor(ZhouPreset::kH, 4);
  EXPECT_LT((zhou.walk.truth.front().position_m - Vector2(8.0, 1.9)).norm(), 1e-6);
  EXPECT_LT((zhou.walk.truth.back().position_m - Vector2(3.0, 1.1)).norm(), 1e-6);
  double furthest_m = 0.0;
  for (const auto& state : zhou.walk.truth) {
    furthest_m = std::max(furthest_m, state.position_m.x());
    EXPECT_GT(state.position_m.y(), 1.05);
    EXPECT_LT(state.position_m.y(), 1.95);
  }
  EXPECT_NEAR(furthest_m, 28.0, 0.7);
  // 20 m + 0.8 m + 25 m, corners cut.
  double length_m = 0.0;
  for (const auto& step : zhou.walk.steps) length_m += step.length_m;
  EXPECT_NEAR(length_m, 45.8, 1.3);
}

TEST(PaperRooms, MapTheFieldThatThePhoneFeels) {
  const auto room = *zhou_corridor(ZhouPreset::kA, 6);
  double sum_ut2 = 0.0;
  std::size_t count = 0;
  for (const sample::Sample& sample : room.walk.samples) {
    const auto* field = std::get_if<sample::MagnetometerSample>(&sample);
    if (field == nullptr) continue;
    const double x_m = truth_at(room.walk, field->time).x();
    const auto& point = room.magnetic_map[static_cast<std::size_t>(std::lround(x_m / 0.2))];
    sum_ut2 += std::pow(field->field_ut.z() - point.vertical_ut, 2.0);
    ++count;
  }
  // Noise of phone and survey, 0.5 and 0.7 uT, and up to 0.1 m of the grid.
  EXPECT_LT(std::sqrt(sum_ut2 / static_cast<double>(count)), 3.0);
}

TEST(PaperRooms, CalibrateTheSamePersonAsWalks) {
  const auto walk = *zhong_walk(ZhongKind::kPhoto, 8);
  EXPECT_NEAR(walk.calibration_length_m, 30.0, 1e-6);
  EXPECT_NEAR(walk.length_m, 50.0, 1.5);
  EXPECT_EQ(walk.calibration_steps, walk.calibration.steps.size());
  const auto mean_m = [](const std::vector<sim::StepTruth>& steps) {
    double sum_m = 0.0;
    double count = 0.0;
    for (const auto& step : steps) {
      sum_m += step.length_m;
      if (step.is_effective) count += 1.0;
    }
    return sum_m / count;
  };
  EXPECT_NEAR(mean_m(walk.calibration.steps) / mean_m(walk.walk.steps), 1.0, 0.05);
  const auto in_place =
      std::count_if(walk.walk.steps.begin(), walk.walk.steps.end(),
                    [](const sim::StepTruth& step) { return !step.is_effective; });
  EXPECT_GE(in_place, 3 * 4);
  EXPECT_LE(in_place, 3 * 9);
}

TEST(PaperRooms, RepeatThemselvesBySeed) {
  const auto a = *zhao_square(ZhaoPreset::kNormal, 9);
  const auto b = *zhao_square(ZhaoPreset::kNormal, 9);
  EXPECT_EQ(a.walk.samples, b.walk.samples);
  EXPECT_EQ(a.survey, b.survey);
  EXPECT_EQ(a.start_scans, b.start_scans);
  EXPECT_NE(zhao_square(ZhaoPreset::kNormal, 10)->walk.samples, a.walk.samples);
}

}  // namespace
}  // namespace waylode::experiment
