// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "waylode/core/result.hpp"
#include "waylode/fusion/planar_estimate.hpp"
#include "waylode/fusion/step_position_filter.hpp"

namespace waylode::fusion {

/// What becomes of a fingerprint fix that disagrees with the way walked.
enum class DecisionMode : std::uint8_t {
  kEveryFix,       ///< The filter takes every fix, whatever the difference.
  kOnlyWhenLarge,  ///< The filter takes a fix only when it is far from the walked position.
  kWuLiteral,      ///< No filter: the last pairs' mean difference shifts the walked position.
};

/// Start by fingerprint, walk by PDR, compare with the fingerprint, keep a small difference and
/// correct a large one [Wu2019] figure 3.
class DecisionFlow {
 public:
  struct Options {
    DecisionMode mode = DecisionMode::kEveryFix;
    double threshold_m = 2.0;  ///< Difference that counts as large; >= 0. Not used by kEveryFix.
    int pairs = 5;  ///< kWuLiteral: compared pairs that a correction averages; 1 to 1000.
    /// kWuLiteral: where between walked (0) and fingerprint (1) the corrected position lies.
    double literal_gain_ratio = 0.5;
    StepPositionFilter::Options filter;

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// How a fix compared with the walked position.
  struct Comparison {
    double difference_m = 0.0;
    bool corrected = false;
  };

  /// `options` are valid.
  explicit DecisionFlow(const Options& options);

  void start(const PlanarEstimate& place);
  bool started() const { return filter_.started(); }
  /// False, and nothing changes: not sound, before the last event, or nothing started.
  bool add(const observation::MotionDelta& motion);
  /// Begins where nothing has. nullopt, and nothing changes: see StepPositionFilter.
  std::optional<Comparison> add(const PlanarMeasurement& fix);
  /// Carried to `time` (not before the last event). Something has started.
  PlanarEstimate at(core::DeviceTime time) const;
  /// Of kEveryFix and kOnlyWhenLarge.
  const StepPositionFilter& filter() const { return filter_; }

 private:
  void begin(const PlanarEstimate& place);
  Comparison compare_literally(const PlanarMeasurement& fix);

  Options options_;
  StepPositionFilter filter_;
  core::DeviceTime last_fix_;
  // Of kWuLiteral.
  PlanarEstimate walked_;
  PathMemory path_;
  std::deque<core::Vector2> differences_m_;  ///< Fingerprint less walked, after all corrections.
};

}  // namespace waylode::fusion
