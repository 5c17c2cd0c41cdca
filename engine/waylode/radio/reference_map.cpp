// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/reference_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "waylode/core/assert.hpp"

namespace waylode::radio {
namespace {

bool is_bluetooth(core::TransmitterId transmitter) {
  return transmitter.kind() == core::TransmitterId::Kind::kBluetooth;
}

core::Vector2 place_of(const site::FingerprintRecord& record) {
  return {static_cast<double>(record.x_m), static_cast<double>(record.y_m)};
}

/// Assigns each place of a floor to the nearest leader within the radius, else makes it a leader.
class LeaderClusters {
 public:
  explicit LeaderClusters(double radius_m)
      : radius_m_(radius_m), cell_m_(std::max(radius_m, kFinest_m)) {}

  void next_floor() { cells_.clear(); }

  /// The cluster's number; a new one counts on.
  std::uint32_t assign(const core::Vector2& place_m) {
    const auto [column, row] = cell_of(place_m);
    std::optional<std::pair<double, std::uint32_t>> nearest;  // Squared distance, then number.
    for (std::int64_t i = column - 1; i <= column + 1; ++i) {
      for (std::int64_t j = row - 1; j <= row + 1; ++j) {
        const auto cell = cells_.find({i, j});
        if (cell == cells_.end()) continue;
        for (const auto& [leader_m, number] : cell->second) {
          const std::pair candidate{(leader_m - place_m).squaredNorm(), number};
          if (candidate.first > radius_m_ * radius_m_) continue;
          if (!nearest || candidate < *nearest) nearest = candidate;
        }
      }
    }
    if (nearest) return nearest->second;
    cells_[{column, row}].emplace_back(place_m, count_);
    return count_++;
  }

 private:
  static constexpr double kFinest_m = 1e-3;
  using Cell = std::pair<std::int64_t, std::int64_t>;

  Cell cell_of(const core::Vector2& place_m) const {
    return {static_cast<std::int64_t>(std::floor(place_m.x() / cell_m_)),
            static_cast<std::int64_t>(std::floor(place_m.y() / cell_m_))};
  }

  double radius_m_;
  double cell_m_;
  std::uint32_t count_ = 0;
  std::map<Cell, std::vector<std::pair<core::Vector2, std::uint32_t>>> cells_;
};

/// One reading of the map, on its way to its point.
struct Loose {
  std::uint32_t point = 0;
  std::uint32_t transmitter = 0;
  float rssi_dbm = 0.0F;
};

/// Runs of equal point and transmitter, one after the other.
template <typename Visit>
void for_each_run(std::span<const Loose> sorted, const Visit& visit) {
  for (auto begin = sorted.begin(); begin != sorted.end();) {
    const auto end = std::find_if(begin, sorted.end(), [&](const Loose& loose) {
      return loose.point != begin->point || loose.transmitter != begin->transmitter;
    });
    visit(std::span(begin, end));
    begin = end;
  }
}

/// Louder first; then the earlier of equals; Bluetooth after all else.
bool is_stronger(const ReferenceMap::Reading& a, const ReferenceMap::Reading& b,
                 std::span<const core::TransmitterId> transmitters) {
  const bool a_bluetooth = is_bluetooth(transmitters[a.transmitter]);
  const bool b_bluetooth = is_bluetooth(transmitters[b.transmitter]);
  if (a_bluetooth != b_bluetooth) return b_bluetooth;
  return a.mean_dbm > b.mean_dbm;
}

}  // namespace

core::Result<void> ReferenceMap::Options::validate() const {
  const auto refuse = [](const char* message) {
    return core::fail(core::ErrorCode::kInvalidOptions, message, "reference_map");
  };
  if (!(merge_radius_m >= 0.0 && merge_radius_m <= 100.0)) {
    return refuse("merge_radius_m must be in [0, 100]");
  }
  if (!(fill_dbm >= -127.5F && fill_dbm <= -50.0F)) {
    return refuse("fill_dbm must be in [-127.5, -50]");
  }
  if (!(min_heard_ratio >= 0.0 && min_heard_ratio <= 1.0)) {
    return refuse("min_heard_ratio must be in [0, 1]");
  }
  return filter.validate();
}

core::Result<ReferenceMap> ReferenceMap::create(const site::RadioMap& map, const Options& options) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  ReferenceMap result(options);
  result.number_transmitters(map);
  result.gather(map);
  result.index();
  return result;
}

void ReferenceMap::number_transmitters(const site::RadioMap& map) {
  for (const std::uint64_t packed : map.transmitters) {
    transmitters_.push_back(core::TransmitterId::from_packed(packed));
  }
}

void ReferenceMap::gather(const site::RadioMap& map) {
  LeaderClusters clusters(options_.merge_radius_m);
  std::vector<std::uint32_t> point_of(map.fingerprints.size(), kNobody);
  for (std::size_t i = 0; i < map.fingerprints.size(); ++i) {
    const site::FingerprintRecord& record = map.fingerprints[i];
    ++report_.instances;
    constexpr double kFarthest_m = 1e7;  // Beyond any building; keeps cell numbers within range.
    const core::Vector2 place_m = place_of(record);
    if (!(place_m.cwiseAbs().maxCoeff() <= kFarthest_m)) {
      ++report_.instances_unplaced;
      continue;
    }
    const core::FloorId floor{record.floor};
    if (points_.empty() || points_.back().floor != floor) clusters.next_floor();
    point_of[i] = clusters.assign(place_m);
    if (point_of[i] == points_.size()) points_.push_back({.floor = floor});
    Point& point = points_[point_of[i]];
    ++point.instances;
    point.position_m += (place_m - point.position_m) / static_cast<double>(point.instances);
  }

  std::vector<Loose> loose;
  for (std::uint32_t t = 0; t < transmitters_.size(); ++t) {
    for (std::uint32_t i = map.posting_begin[t]; i < map.posting_begin[t + 1]; ++i) {
      const std::uint32_t point = point_of[map.postings[i].fingerprint];
      if (point != kNobody) loose.push_back({point, t, map.postings[i].rssi_dbm()});
    }
  }
  std::ranges::stable_sort(loose, {},
                           [](const Loose& l) { return std::pair(l.point, l.transmitter); });
  report_.readings = loose.size();

  const DomainFilter filter(options_.filter);
  std::vector<float> rssi_dbm;
  for_each_run(loose, [&](std::span<const Loose> run) {
    Point& point = points_[run.front().point];
    const auto heard = static_cast<double>(run.size());
    if (heard < options_.min_heard_ratio * static_cast<double>(point.instances)) {
      report_.readings_rare += run.size();
      return;
    }
    rssi_dbm.clear();
    for (const Loose& one : run) rssi_dbm.push_back(one.rssi_dbm);
    const DomainFilter::Outcome outcome = filter.apply(rssi_dbm);
    report_.readings_replaced += outcome.replaced.size();
    const auto statistics = signal_statistics(outcome.rssi_dbm);
    WAYLODE_ASSERT(statistics.has_value());
    if (point.reading_count == 0) {
      point.first_reading = static_cast<std::uint32_t>(readings_.size());
    }
    ++point.reading_count;
    readings_.push_back({run.front().transmitter, static_cast<std::uint32_t>(statistics->count),
                         statistics->mean_dbm, statistics->sigma_db});
  });
}

void ReferenceMap::index() {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> hearing;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> regions;
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    Point& point = points_[i];
    if (floors_.empty() || floors_.back().floor != point.floor) {
      floors_.push_back({point.floor, i, i});
    }
    floors_.back().last = i + 1;
    const Reading* strongest = nullptr;
    for (const Reading& reading : readings_of(i)) {
      hearing.emplace_back(reading.transmitter, i);
      if (strongest == nullptr || is_stronger(reading, *strongest, transmitters_)) {
        strongest = &reading;
      }
    }
    if (strongest == nullptr) continue;
    point.strongest = strongest->transmitter;
    regions.emplace_back(point.strongest, i);
  }
  const auto freeze = [&](std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs) {
    std::ranges::sort(pairs);
    Index index;
    index.begin.assign(transmitters_.size() + 1, 0);
    for (const auto& [transmitter, point] : pairs) {
      ++index.begin[transmitter + 1];
      index.points.push_back(point);
    }
    for (std::size_t t = 0; t < transmitters_.size(); ++t) index.begin[t + 1] += index.begin[t];
    return index;
  };
  hearing_ = freeze(std::move(hearing));
  regions_ = freeze(std::move(regions));
}

std::span<const ReferenceMap::Reading> ReferenceMap::readings_of(std::uint32_t point) const {
  return std::span(readings_).subspan(points_[point].first_reading, points_[point].reading_count);
}

std::span<const std::uint32_t> ReferenceMap::on_floor(const Index& index, std::uint32_t transmitter,
                                                      core::FloorId floor) const {
  const auto range = std::ranges::find(floors_, floor, &FloorRange::floor);
  if (range == floors_.end()) return {};
  const auto all = std::span(index.points)
                       .subspan(index.begin[transmitter],
                                index.begin[transmitter + 1] - index.begin[transmitter]);
  return {std::ranges::lower_bound(all, range->first), std::ranges::lower_bound(all, range->last)};
}

std::span<const std::uint32_t> ReferenceMap::points_hearing(std::uint32_t transmitter,
                                                            core::FloorId floor) const {
  return on_floor(hearing_, transmitter, floor);
}

std::span<const std::uint32_t> ReferenceMap::region_of(std::uint32_t transmitter,
                                                       core::FloorId floor) const {
  return on_floor(regions_, transmitter, floor);
}

float ReferenceMap::mean_dbm(std::uint32_t point, std::uint32_t transmitter) const {
  const auto readings = readings_of(point);
  const auto found = std::ranges::lower_bound(readings, transmitter, {}, &Reading::transmitter);
  if (found == readings.end() || found->transmitter != transmitter) {
    return std::numeric_limits<float>::quiet_NaN();
  }
  return found->mean_dbm;
}

ReferenceQuery ReferenceMap::prepare(std::span<const QueryReading> readings) const {
  struct Sum {
    double rssi_dbm = 0.0;
    double count = 0.0;
  };
  std::map<core::TransmitterId, Sum> heard;
  for (const QueryReading& reading : readings) {
    if (!std::isfinite(reading.rssi_dbm)) continue;
    Sum& sum = heard[reading.transmitter];
    sum.rssi_dbm += static_cast<double>(reading.rssi_dbm);
    sum.count += 1.0;
  }

  ReferenceQuery query;
  query.excess_db.assign(transmitters_.size(), 0.0);
  constexpr double kTrace_db = 1.0;  // At or below the fill value it was heard all the same.
  double all_db = 0.0;
  double known_db = 0.0;
  std::array<bool, 2> listens = {false, false};  // To all else, to Bluetooth.
  for (const auto& [transmitter, sum] : heard) {
    const double excess_db = sum.rssi_dbm / sum.count - static_cast<double>(options_.fill_dbm);
    listens[is_bluetooth(transmitter) ? 1 : 0] = true;
    all_db += std::max(kTrace_db, excess_db);
    const auto found = std::ranges::lower_bound(transmitters_, transmitter);
    if (found == transmitters_.end() || *found != transmitter) continue;
    const auto index = static_cast<std::uint32_t>(found - transmitters_.begin());
    known_db += std::max(kTrace_db, excess_db);
    query.heard.push_back({index, excess_db});
    query.excess_db[index] = excess_db;
  }
  if (all_db > 0.0) query.known_share_ratio = known_db / all_db;
  for (std::size_t t = 0; t < transmitters_.size(); ++t) {
    if (!listens[is_bluetooth(transmitters_[t]) ? 1 : 0]) {
      query.excess_db[t] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  return query;
}

// [Wu2019] eq. (2), [Zhou2016] eq. (1), [Zhao2019] eq. (16)
double ReferenceMap::distance_db(const ReferenceQuery& query, std::uint32_t point,
                                 Compared compared) const {
  WAYLODE_ASSERT(query.excess_db.size() == transmitters_.size());
  double square = 0.0;
  double common = 0.0;
  const auto readings = readings_of(point);
  auto reading = readings.begin();
  const auto excess_of = [&](const Reading& r) {
    return static_cast<double>(r.mean_dbm) - static_cast<double>(options_.fill_dbm);
  };
  const auto alone = [&](const Reading& r) {
    if (compared != Compared::kUnion || std::isnan(query.excess_db[r.transmitter])) return;
    square += excess_of(r) * excess_of(r);
  };
  for (const ReferenceQuery::Heard& heard : query.heard) {
    while (reading != readings.end() && reading->transmitter < heard.transmitter) alone(*reading++);
    double difference = heard.excess_db;
    if (reading != readings.end() && reading->transmitter == heard.transmitter) {
      difference -= excess_of(*reading++);
      common += 1.0;
    } else if (compared == Compared::kCommonMean) {
      continue;
    }
    square += difference * difference;
  }
  while (reading != readings.end()) alone(*reading++);
  if (compared != Compared::kCommonMean) return std::sqrt(square);
  return common > 0.0 ? std::sqrt(square / common) : std::numeric_limits<double>::infinity();
}

}  // namespace waylode::radio
