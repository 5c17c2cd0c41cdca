// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/id.hpp"
#include "waylode/core/result.hpp"
#include "waylode/observation/likelihood_raster.hpp"
#include "waylode/radio/raster_mixture.hpp"
#include "waylode/radio/scan_assembler.hpp"
#include "waylode/site/radio_map.hpp"

namespace waylode::radio {

/// What a phone at one place would hear of one transmitter.
struct ExpectedSignal {
  double mean_dbm = 0.0;
  double sigma_db = 0.0;
  double heard_ratio = 0.0;  ///< Probability that a scan hears it, 0 to 1.
};

/// What is to be heard at each place of each floor, transmitter by transmitter, and hence how well
/// a scan fits there, silence included. The kernel mean of the survey about each transmitter's path
/// loss; away from surveyed ground the nearest survey stands in, with growing doubt. Immutable, so
/// that any number of sessions share one; keeps nothing of the map it was made from.
class SignalField {
 public:
  struct Options {
    double node_m = 2.0;     ///< Between nodes, 0.5 to 20.
    double margin_m = 10.0;  ///< Around the survey, 0 to 200.
    double kernel_m = 3.5;   ///< Standard deviation of the survey's kernel, above 0, to 50.
    /// Away from the survey prior_sigma_db joins the doubt, all but 1/e of it over this distance;
    /// above 0, to 1000.
    double fade_m = 10.0;
    double prior_weight = 0.15;     ///< The path loss counts as this many fingerprints; above 0.
    double prior_sigma_db = 8.0;    ///< Of a transmitter about its path loss, above 0.
    double min_sigma_db = 6.0;      ///< What a moving phone's reading scatters at least, above 0.
    double hearing_dbm = -82.0;     ///< Expected strength that half of the scans hear.
    double hearing_scale_db = 5.0;  ///< Over which hearing sets in (logistic), above 0.
    /// Probability of a surprise: to hear what is not to be heard, or the reverse. Above 0, to 0.2.
    double surprise_ratio = 0.02;
    /// Transmitters share walls, bodies and survey: a scan tells as much as this many independent
    /// ones. Above 0.
    double effective_transmitters = 4.0;
    /// A reading's weight fades by this factor per second of age beyond one; above 0, to 1.
    double age_decay_per_s = 0.85;

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  static core::Result<SignalField> create(const site::RadioMap& map, const Options& options);

  /// Empty for a floor without survey, and for a query of which the map knows nothing. Readings
  /// that are not finite are passed over. A kind that the phone did not hear at all says nothing.
  observation::LikelihoodRaster likelihood(const Query& query, core::FloorId floor) const;

  /// At the node nearest to a place. nullopt off the raster, and where the transmitter is expected
  /// no more than by surprise.
  std::optional<ExpectedSignal> expected(core::TransmitterId transmitter, core::FloorId floor,
                                         const core::Vector2& position_m) const;

  /// The raster of a floor; nullopt for a floor without survey.
  std::optional<RasterGeometry> geometry(core::FloorId floor) const;
  std::size_t bytes() const;  ///< Of the stored field, about.

 private:
  /// Strength in units of half a dB below 0, sigma of a tenth, probability of 1/255.
  struct Cell {
    std::uint8_t attenuation_half_db = 0;
    std::uint8_t sigma_tenth_db = 0;
    std::uint8_t heard_255 = 0;
  };
  /// Cells of neighbouring nodes, one transmitter: from `node` on, up to the next run's first cell.
  struct Run {
    std::uint32_t node = 0;
    std::uint32_t cell = 0;
  };
  struct FloorField {
    core::FloorId floor;
    RasterGeometry geometry;
    std::vector<std::uint32_t> run_begin;  ///< Per transmitter + 1, into runs.
    std::vector<Run> runs;                 ///< Per transmitter by rising node, and one at the end.
    std::vector<Cell> cells;
    /// Per kind of TransmitterId and node: sum of log(1 - p) over its transmitters, less what a
    /// place far from all of them would have.
    std::array<std::vector<float>, 3> silence;
  };
  explicit SignalField(const Options& options);
  const FloorField* find(core::FloorId floor) const;
  std::optional<std::size_t> index_of(core::TransmitterId transmitter) const;
  /// Replaces the transmitter's silence by what was heard of it, less a surprise, node by node.
  void add_heard(const FloorField& floor, std::size_t transmitter, float rssi_dbm, double weight,
                 std::vector<float>& sum) const;
  /// log of the probability to hear it and of the density of what was heard.
  float heard_log(const Cell& cell, int rssi_half_db) const;
  /// The same far from the transmitter.
  double surprise_log() const;
  /// log of the probability of silence, less that of silence far from the transmitter.
  float silence_log(const Cell& cell) const { return silence_log_[cell.heard_255]; }
  FloorField build(const site::RadioMap& map, std::uint32_t begin, std::uint32_t end) const;

  Options options_;
  /// Tables of the logarithms: by Cell::heard_255; by sigma and difference in half dB.
  std::array<float, 256> ratio_log_{};
  std::array<float, 256> silence_log_{};
  std::vector<float> density_log_;
  std::vector<std::uint64_t> transmitters_;  ///< Packed, ascending.
  std::vector<FloorField> floors_;           ///< By floor.
};

}  // namespace waylode::radio
