// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "waylode/radio/path_loss.hpp"
#include "waylode/radio/signal_field.hpp"

namespace waylode::radio {
namespace {

core::Vector2 place_of(const site::FingerprintRecord& record) {
  return {static_cast<double>(record.x_m), static_cast<double>(record.y_m)};
}

/// Nodes cover `places_m` and the margin; none without a finite place. More than a kilometre of
/// nodes would be a label gone astray: the raster is cut there.
RasterGeometry geometry_of(const std::vector<core::Vector2>& places_m,
                           const SignalField::Options& options) {
  constexpr double kMostNodes = 1000.0;
  RasterGeometry geometry{core::Vector2::Zero(), options.node_m, 0, 0};
  core::Vector2 low_m = core::Vector2::Zero();
  core::Vector2 high_m = core::Vector2::Zero();
  bool first = true;
  for (const core::Vector2& place_m : places_m) {
    if (!place_m.allFinite()) continue;
    low_m = first ? place_m : low_m.cwiseMin(place_m).eval();
    high_m = first ? place_m : high_m.cwiseMax(place_m).eval();
    first = false;
  }
  if (first) return geometry;
  const core::Vector2 margin_m(options.margin_m, options.margin_m);
  geometry.origin_m = low_m - margin_m;
  const core::Vector2 steps = (high_m + margin_m - geometry.origin_m) / options.node_m;
  geometry.columns = static_cast<std::size_t>(std::min(kMostNodes, std::ceil(steps.x()))) + 1;
  geometry.rows = static_cast<std::size_t>(std::min(kMostNodes, std::ceil(steps.y()))) + 1;
  return geometry;
}

/// A transmitter taken to stand where it was heard loudest.
struct Emitter {
  std::size_t index = 0;  ///< In the map.
  std::size_t band = 0;
  core::Vector2 position_m = core::Vector2::Zero();
  PathLoss law;

  double distance_m(const core::Vector2& place_m) const {
    constexpr double kHeight_m = 3.0;  // Above the phone, and by which its place is unknown.
    return std::hypot((place_m - position_m).norm(), kHeight_m);
  }
  double mean_dbm(const core::Vector2& place_m) const {
    constexpr double kLowest_dbm = -110.0;
    return std::max(kLowest_dbm, law.mean_dbm(distance_m(place_m)));
  }
};

/// Where the field strength's centre of gravity is; amplitude squared, so that the loud ones
/// decide.
core::Vector2 loudest_place(const std::vector<PlacedReading>& readings) {
  core::Vector2 sum = core::Vector2::Zero();
  double weights = 0.0;
  for (const PlacedReading& reading : readings) {
    const double weight = std::pow(10.0, 0.1 * reading.rssi_dbm);
    sum += weight * reading.position_m;
    weights += weight;
  }
  return sum / weights;
}

/// The law's slope is fitted where there are enough readings for one that makes sense.
Emitter emitter_of(std::size_t index, std::size_t band,
                   const std::vector<PlacedReading>& readings) {
  constexpr std::size_t kEnough = 8;
  constexpr double kLeastExponent = 1.5;
  constexpr double kMostExponent = 5.0;
  constexpr double kUsualExponent = 3.0;
  Emitter emitter{index, band, loudest_place(readings), {}};
  std::vector<DistanceReading> distances;
  for (const PlacedReading& reading : readings) {
    distances.push_back({emitter.distance_m(reading.position_m), reading.rssi_dbm});
  }
  emitter.law.exponent = kUsualExponent;
  if (distances.size() >= kEnough) {
    if (const auto fit = fit_path_loss(distances)) {
      emitter.law.exponent = std::clamp(fit->law.exponent, kLeastExponent, kMostExponent);
    }
  }
  double level_dbm = 0.0;
  for (const DistanceReading& reading : distances) {
    level_dbm += reading.rssi_dbm + 10.0 * emitter.law.exponent * std::log10(reading.distance_m);
  }
  emitter.law.reference_dbm = level_dbm / static_cast<double>(distances.size());
  return emitter;
}

/// What a fingerprint heard of a transmitter, less what its law expects there.
struct Residual {
  std::uint32_t emitter = 0;
  float residual_db = 0.0F;
};

struct Survey {
  std::vector<core::Vector2> places_m;
  std::vector<std::vector<Residual>> residuals;  ///< Per fingerprint.
  std::vector<std::array<bool, 3>> listens;      ///< Per fingerprint: heard any of the kind.
  std::vector<Emitter> emitters;
};

Survey survey_of(const site::RadioMap& map, std::uint32_t begin, std::uint32_t end) {
  Survey survey;
  for (std::uint32_t i = begin; i < end; ++i) {
    survey.places_m.push_back(place_of(map.fingerprints[i]));
  }
  survey.residuals.resize(survey.places_m.size());
  survey.listens.resize(survey.places_m.size());
  for (std::size_t t = 0; t < map.transmitters.size(); ++t) {
    const auto all =
        map.postings.subspan(map.posting_begin[t], map.posting_begin[t + 1] - map.posting_begin[t]);
    const auto first = std::ranges::lower_bound(all, begin, {}, &site::Posting::fingerprint);
    std::vector<PlacedReading> readings;
    std::vector<std::size_t> heard_by;
    for (auto posting = first; posting != all.end() && posting->fingerprint < end; ++posting) {
      const std::size_t place = posting->fingerprint - begin;
      if (!survey.places_m[place].allFinite()) continue;
      readings.push_back({survey.places_m[place], static_cast<double>(posting->rssi_dbm())});
      heard_by.push_back(place);
    }
    if (readings.empty()) continue;
    const auto kind = core::TransmitterId::from_packed(map.transmitters[t]).kind();
    const Emitter emitter =
        emitter_of(t, std::min<std::size_t>(2, static_cast<std::size_t>(kind)), readings);
    for (std::size_t i = 0; i < readings.size(); ++i) {
      const double residual_db = readings[i].rssi_dbm - emitter.mean_dbm(readings[i].position_m);
      survey.residuals[heard_by[i]].push_back(
          {static_cast<std::uint32_t>(survey.emitters.size()), static_cast<float>(residual_db)});
      survey.listens[heard_by[i]][emitter.band] = true;
    }
    survey.emitters.push_back(emitter);
  }
  return survey;
}

/// Kernel sums of one transmitter's residuals about a node.
struct Sums {
  double weight = 0.0;
  double residual = 0.0;
  double square = 0.0;
};

struct Neighbours {
  std::vector<Sums> heard;            ///< Per emitter.
  std::array<double, 3> listening{};  ///< Weight of the fingerprints that listen, per kind.
  double doubt = 0.0;                 ///< 0 beside the survey, towards 1 away from it.
};

/// Beside the survey a fixed kernel; away from it one that widens to reach.
Neighbours gather(const Survey& survey, const core::Vector2& node_m,
                  const SignalField::Options& options) {
  constexpr double kReachSigmas = 3.0;
  Neighbours around;
  around.heard.resize(survey.emitters.size());
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const core::Vector2& place_m : survey.places_m) {
    if (place_m.allFinite()) nearest_m = std::min(nearest_m, (place_m - node_m).norm());
  }
  const double kernel_m = std::max(options.kernel_m, nearest_m);
  const double away_m = std::max(0.0, nearest_m - options.kernel_m);
  around.doubt = 1.0 - std::exp(-away_m / options.fade_m);
  for (std::size_t i = 0; i < survey.places_m.size(); ++i) {
    const double off = (survey.places_m[i] - node_m).norm() / kernel_m;
    if (!(off <= kReachSigmas)) continue;
    const double weight = std::exp(-0.5 * off * off);
    for (std::size_t band = 0; band < 3; ++band) {
      if (survey.listens[i][band]) around.listening[band] += weight;
    }
    for (const Residual& residual : survey.residuals[i]) {
      Sums& sums = around.heard[residual.emitter];
      const auto residual_db = static_cast<double>(residual.residual_db);
      sums.weight += weight;
      sums.residual += weight * residual_db;
      sums.square += weight * residual_db * residual_db;
    }
  }
  return around;
}

/// The law is a prior of so many fingerprints, of mean 0 among the residuals.
ExpectedSignal blend(double law_dbm, const Sums& sums, double listening, double doubt,
                     const SignalField::Options& options) {
  const double weight = sums.weight + options.prior_weight;
  const double shift_db = sums.residual / weight;
  const double prior_db2 = options.prior_sigma_db * options.prior_sigma_db;
  const double scatter_db2 =
      (sums.square + options.prior_weight * prior_db2) / weight - shift_db * shift_db;
  const double heard_by_law =
      1.0 / (1.0 + std::exp((options.hearing_dbm - law_dbm) / options.hearing_scale_db));
  ExpectedSignal signal;
  signal.mean_dbm = law_dbm + shift_db;
  signal.sigma_db = std::sqrt(std::max(scatter_db2, options.min_sigma_db * options.min_sigma_db) +
                              doubt * prior_db2);
  signal.heard_ratio =
      (sums.weight + options.prior_weight * heard_by_law) / (listening + options.prior_weight);
  signal.heard_ratio = std::min(signal.heard_ratio, 1.0 - options.surprise_ratio);
  return signal;
}

std::uint8_t byte_of(double value) {
  return static_cast<std::uint8_t>(std::clamp(std::lround(value), 1L, 255L));
}

}  // namespace

SignalField::FloorField SignalField::build(const site::RadioMap& map, std::uint32_t begin,
                                           std::uint32_t end) const {
  const Survey survey = survey_of(map, begin, end);
  FloorField field;
  field.floor = core::FloorId{map.fingerprints[begin].floor};
  field.geometry = geometry_of(survey.places_m, options_);
  for (std::vector<float>& silence : field.silence) silence.resize(field.geometry.nodes());
  std::vector<std::vector<Cell>> cells(survey.emitters.size());
  std::vector<std::vector<Run>> runs(survey.emitters.size());
  std::vector<std::uint32_t> next_node(survey.emitters.size(), 0);
  for (std::uint32_t node = 0; node < field.geometry.nodes(); ++node) {
    const core::Vector2 node_m = field.geometry.node_at(node);
    const Neighbours around = gather(survey, node_m, options_);
    for (std::size_t e = 0; e < survey.emitters.size(); ++e) {
      const Emitter& emitter = survey.emitters[e];
      const ExpectedSignal signal = blend(emitter.mean_dbm(node_m), around.heard[e],
                                          around.listening[emitter.band], around.doubt, options_);
      if (!(signal.heard_ratio > options_.surprise_ratio)) continue;
      if (cells[e].empty() || next_node[e] != node) {
        runs[e].push_back({node, static_cast<std::uint32_t>(cells[e].size())});
      }
      next_node[e] = node + 1;
      cells[e].push_back({byte_of(-2.0 * signal.mean_dbm), byte_of(10.0 * signal.sigma_db),
                          byte_of(255.0 * signal.heard_ratio)});
      field.silence[emitter.band][node] += silence_log(cells[e].back());
    }
  }
  field.run_begin.assign(map.transmitters.size() + 1, 0);
  for (std::size_t e = 0; e < survey.emitters.size(); ++e) {
    field.run_begin[survey.emitters[e].index + 1] = static_cast<std::uint32_t>(runs[e].size());
    const auto before = static_cast<std::uint32_t>(field.cells.size());
    for (const Run& run : runs[e]) field.runs.push_back({run.node, run.cell + before});
    field.cells.insert(field.cells.end(), cells[e].begin(), cells[e].end());
  }
  field.runs.push_back({0, static_cast<std::uint32_t>(field.cells.size())});
  for (std::size_t t = 0; t < map.transmitters.size(); ++t) {
    field.run_begin[t + 1] += field.run_begin[t];
  }
  return field;
}

}  // namespace waylode::radio
