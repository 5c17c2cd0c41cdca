// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "waylode/core/result.hpp"
#include "waylode/sample/sample.hpp"

namespace waylode::radio {

/// What repeated readings of one transmitter at one place have in common.
struct SignalStatistics {
  std::size_t count = 0;
  float mean_dbm = 0.0F;
  float min_dbm = 0.0F;
  float max_dbm = 0.0F;
  float median_dbm = 0.0F;
  float mad_db = 0.0F;    ///< Median absolute deviation from the median; unscaled.
  float sigma_db = 0.0F;  ///< Standard deviation of the sample (n - 1); 0 for a single reading.

  bool operator==(const SignalStatistics&) const = default;
};

/// nullopt without a finite reading; others than finite ones are passed over.
std::optional<SignalStatistics> signal_statistics(std::span<const float> rssi_dbm);

/// Replaces readings that lie outside the domain of their fellows at the same place.
class DomainFilter {
 public:
  enum class Mode : std::uint8_t {
    kOff,
    /// |R - mean| <= (max - min) / 2, else the mean. Rejects outliers on one side only; with some
    /// on both sides it takes away the wrong ones.
    kHalfRange,
    kMad,  ///< |R - median| <= mad_factor * 1.4826 * MAD, else the median.
    /// |R - mean| <= |max + min| / 2, as the sentence of [Wu2019] 1.1 says: some 57 dB to either
    /// side, so that it takes away nothing. Kept for the record.
    kLiteral,
  };

  struct Options {
    Mode mode = Mode::kMad;
    float mad_factor = 3.0F;  ///< Of 1.4826 MAD, which is one sigma of a Gaussian; above 0.
    /// Phones tell whole dB, so that the MAD of a steady signal is 0: no smaller one is believed.
    float min_mad_db = 0.5F;

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  struct Outcome {
    std::vector<float> rssi_dbm;        ///< In the order given, without what is not finite.
    std::vector<std::size_t> replaced;  ///< Indices into rssi_dbm, ascending.
  };

  /// `options` must be valid.
  explicit DomainFilter(const Options& options) : options_(options) {}

  Outcome apply(std::span<const float> rssi_dbm) const;

 private:
  Options options_;
};

/// Drops every reading whose transmitter an earlier one of the same scan time has named, and the
/// scans that lose all. Equal RSSI at another time is no duplicate. Tells how many readings went.
std::size_t remove_duplicates(std::vector<sample::WifiScan>& scans);

}  // namespace waylode::radio
