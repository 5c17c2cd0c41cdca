// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/signal_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace waylode::radio {
namespace {

/// Strengths lie within so many dB; a surprise has any of them alike.
constexpr double kStrengthRange_db = 80.0;
constexpr std::size_t kTableSide = 256;

std::size_t band_of(core::TransmitterId transmitter) {
  return std::min<std::size_t>(2, static_cast<std::size_t>(transmitter.kind()));
}

double weight_of(const QueryReading& reading, double age_decay_per_s) {
  const double old_s = std::max(0.0, static_cast<double>(reading.age_s) - 1.0);
  return std::pow(age_decay_per_s, old_s);
}

int half_db_of(float rssi_dbm) {
  return static_cast<int>(std::lround(2.0F * std::clamp(rssi_dbm, -200.0F, 100.0F)));
}

bool usable(const QueryReading& reading) {
  return std::isfinite(reading.rssi_dbm) && std::isfinite(reading.age_s);
}

}  // namespace

core::Result<void> SignalField::Options::validate() const {
  const auto refuse = [](const char* message) {
    return core::fail(core::ErrorCode::kInvalidOptions, message, "signal field");
  };
  if (!(node_m >= 0.5 && node_m <= 20.0)) return refuse("node_m must be in [0.5, 20]");
  if (!(margin_m >= 0.0 && margin_m <= 200.0)) return refuse("margin_m must be in [0, 200]");
  if (!(kernel_m > 0.0 && kernel_m <= 50.0)) return refuse("kernel_m must be in (0, 50]");
  if (!(fade_m > 0.0 && fade_m <= 1000.0)) return refuse("fade_m must be in (0, 1000]");
  if (!(prior_weight > 0.0 && prior_weight <= 1e6)) {
    return refuse("prior_weight must be in (0, 1e6]");
  }
  if (!(min_sigma_db > 0.0 && prior_sigma_db >= min_sigma_db && prior_sigma_db <= 25.0)) {
    return refuse("min_sigma_db must be above 0, prior_sigma_db in [min_sigma_db, 25]");
  }
  if (!(hearing_dbm >= -127.0 && hearing_dbm <= 0.0 && hearing_scale_db > 0.0 &&
        hearing_scale_db <= 100.0)) {
    return refuse("hearing_dbm must be in [-127, 0], hearing_scale_db in (0, 100]");
  }
  if (!(surprise_ratio >= 0.004 && surprise_ratio <= 0.2)) {
    return refuse("surprise_ratio must be in [0.004, 0.2]");
  }
  if (!(effective_transmitters > 0.0 && effective_transmitters <= 1e6)) {
    return refuse("effective_transmitters must be in (0, 1e6]");
  }
  if (!(age_decay_per_s > 0.0 && age_decay_per_s <= 1.0)) {
    return refuse("age_decay_per_s must be in (0, 1]");
  }
  return {};
}

core::Result<SignalField> SignalField::create(const site::RadioMap& map, const Options& options) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  SignalField field(options);
  field.transmitters_.assign(map.transmitters.begin(), map.transmitters.end());
  const auto count = static_cast<std::uint32_t>(map.fingerprints.size());
  for (std::uint32_t begin = 0; begin < count;) {
    std::uint32_t end = begin;
    while (end < count && map.fingerprints[end].floor == map.fingerprints[begin].floor) ++end;
    FloorField floor = field.build(map, begin, end);
    if (floor.geometry.nodes() > 0) field.floors_.push_back(std::move(floor));
    begin = end;
  }
  return field;
}

SignalField::SignalField(const Options& options)
    : options_(options), density_log_(kTableSide * kTableSide) {
  const double certain = 1.0 - options.surprise_ratio;
  for (std::size_t i = 1; i < kTableSide; ++i) {
    const double ratio = std::min(static_cast<double>(i) / 255.0, certain);
    ratio_log_[i] = static_cast<float>(std::log(ratio));
    silence_log_[i] = static_cast<float>(std::log((1.0 - ratio) / certain));
    const double sigma_db = 0.1 * static_cast<double>(i);
    const double peak = std::numbers::inv_sqrtpi / (std::numbers::sqrt2 * sigma_db);
    for (std::size_t j = 0; j < kTableSide; ++j) {
      const double off = 0.5 * static_cast<double>(j) / sigma_db;
      const double density =
          certain * peak * std::exp(-0.5 * off * off) + options.surprise_ratio / kStrengthRange_db;
      density_log_[i * kTableSide + j] = static_cast<float>(std::log(density));
    }
  }
}

float SignalField::heard_log(const Cell& cell, int rssi_half_db) const {
  const auto off_half_db =
      static_cast<std::size_t>(std::abs(rssi_half_db + static_cast<int>(cell.attenuation_half_db)));
  const std::size_t row = kTableSide * cell.sigma_tenth_db;
  return ratio_log_[cell.heard_255] + density_log_[row + std::min(off_half_db, kTableSide - 1)];
}

double SignalField::surprise_log() const {
  return std::log(options_.surprise_ratio / kStrengthRange_db);
}

void SignalField::add_heard(const FloorField& floor, std::size_t transmitter, float rssi_dbm,
                            double weight, std::vector<float>& sum) const {
  const int rssi_half_db = half_db_of(rssi_dbm);
  const auto part = static_cast<float>(weight);
  const auto surprise = static_cast<float>(weight * surprise_log());
  const std::uint32_t last = floor.run_begin[transmitter + 1];
  for (std::uint32_t r = floor.run_begin[transmitter]; r < last; ++r) {
    const Run& run = floor.runs[r];
    const std::uint32_t end = floor.runs[r + 1].cell;
    for (std::uint32_t i = run.cell; i < end; ++i) {
      const Cell& cell = floor.cells[i];
      sum[run.node + i - run.cell] +=
          part * heard_log(cell, rssi_half_db) - silence_log(cell) - surprise;
    }
  }
}

observation::LikelihoodRaster SignalField::likelihood(const Query& query,
                                                      core::FloorId floor_id) const {
  const FloorField* floor = find(floor_id);
  if (floor == nullptr) return {};
  std::vector<float> sum(floor->geometry.nodes(), 0.0F);
  std::array<bool, 3> listens{};
  double elsewhere = 0.0;
  double weights = 0.0;
  for (const QueryReading& reading : query.readings) {
    const auto transmitter = index_of(reading.transmitter);
    if (!transmitter || !usable(reading)) continue;
    listens[band_of(reading.transmitter)] = true;
    const double weight = weight_of(reading, options_.age_decay_per_s);
    elsewhere += weight * surprise_log();
    weights += weight;
    add_heard(*floor, *transmitter, reading.rssi_dbm, weight, sum);
  }
  if (!(weights > 0.0)) return {};

  const double trust = std::min(1.0, options_.effective_transmitters / weights);
  observation::LikelihoodRaster raster{
      floor->geometry.origin_m,       floor->geometry.node_m,
      floor->geometry.columns,        floor->geometry.rows,
      std::vector<float>(sum.size()), static_cast<float>(trust * elsewhere)};
  for (std::size_t node = 0; node < sum.size(); ++node) {
    double value = static_cast<double>(sum[node]) + elsewhere;
    for (std::size_t band = 0; band < listens.size(); ++band) {
      if (listens[band]) value += static_cast<double>(floor->silence[band][node]);
    }
    raster.log_likelihood[node] = static_cast<float>(trust * value);
  }
  return raster;
}

std::optional<ExpectedSignal> SignalField::expected(core::TransmitterId transmitter,
                                                    core::FloorId floor_id,
                                                    const core::Vector2& position_m) const {
  const FloorField* floor = find(floor_id);
  const auto index = index_of(transmitter);
  if (floor == nullptr || !index || !position_m.allFinite()) return std::nullopt;
  const RasterGeometry& geometry = floor->geometry;
  const core::Vector2 place = ((position_m - geometry.origin_m) / geometry.node_m).array().round();
  const bool inside = place.x() >= 0.0 && place.y() >= 0.0 &&
                      place.x() < static_cast<double>(geometry.columns) &&
                      place.y() < static_cast<double>(geometry.rows);
  if (!inside) return std::nullopt;
  const std::uint32_t node =
      static_cast<std::uint32_t>(place.y()) * static_cast<std::uint32_t>(geometry.columns) +
      static_cast<std::uint32_t>(place.x());
  const auto first = floor->runs.begin() + floor->run_begin[*index];
  const auto last = floor->runs.begin() + floor->run_begin[*index + 1];
  const auto after = std::ranges::upper_bound(first, last, node, {}, &Run::node);
  if (after == first) return std::nullopt;
  const Run& run = *(after - 1);
  const std::uint32_t at = run.cell + node - run.node;
  if (at >= after->cell) return std::nullopt;
  const Cell* cell = &floor->cells[at];
  return ExpectedSignal{
      -0.5 * static_cast<double>(cell->attenuation_half_db),
      0.1 * static_cast<double>(cell->sigma_tenth_db),
      std::min(static_cast<double>(cell->heard_255) / 255.0, 1.0 - options_.surprise_ratio)};
}

std::optional<RasterGeometry> SignalField::geometry(core::FloorId floor_id) const {
  const FloorField* floor = find(floor_id);
  if (floor == nullptr) return std::nullopt;
  return floor->geometry;
}

std::size_t SignalField::bytes() const {
  std::size_t sum = transmitters_.size() * sizeof(std::uint64_t);
  for (const FloorField& floor : floors_) {
    sum += floor.cells.size() * sizeof(Cell) + floor.runs.size() * sizeof(Run) +
           floor.run_begin.size() * sizeof(std::uint32_t) +
           3 * floor.geometry.nodes() * sizeof(float);
  }
  return sum;
}

const SignalField::FloorField* SignalField::find(core::FloorId floor) const {
  const auto found = std::ranges::lower_bound(floors_, floor, {}, &FloorField::floor);
  return found != floors_.end() && found->floor == floor ? &*found : nullptr;
}

std::optional<std::size_t> SignalField::index_of(core::TransmitterId transmitter) const {
  const auto found = std::ranges::lower_bound(transmitters_, transmitter.packed());
  if (found == transmitters_.end() || *found != transmitter.packed()) return std::nullopt;
  return static_cast<std::size_t>(found - transmitters_.begin());
}

}  // namespace waylode::radio
