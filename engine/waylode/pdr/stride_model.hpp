// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "waylode/core/result.hpp"
#include "waylode/observation/observation.hpp"
#include "waylode/pdr/step_source.hpp"

namespace waylode::pdr {

/// What a person's own walks have corrected; see StrideCalibrator.
struct StrideGains {
  double mean_gain = 0.1124;   ///< [Wu2019] K1, dimensionless; prior of [Zhao2019].
  double swing_gain = 0.2243;  ///< [Wu2019] K2, m per (m/s2)^(1/4); prior of [Zhao2019].
  double scale_ratio = 1.0;    ///< Of every length.

  bool operator==(const StrideGains&) const = default;
};

/// Length of a step. A person's constant factor remains and is a state of fusion.
class StrideModel {
 public:
  enum class Model {
    kThreeTerm,     ///< constant_m + swing_gain swing^(1/4) + cadence_gain_m_s (cadence - 1.9 Hz).
    kWeinberg,      ///< swing_gain swing^(1/4).
    kScarlett,      ///< scarlett_gain_m (mean - lowest) / swing.
    kKim,           ///< kim_gain mean|a|^(1/kim_root).
    kImproved,      ///< gains.mean_gain mean|a| T + gains.swing_gain swing^(1/4).
    kChen,          ///< From height and cadence; near linear in both.
    kProportional,  ///< 0.413 of the height.
    kTable,         ///< Of the height by cadence, in seven coarse rows.
  };
  /// Which mean kImproved takes. The papers do not say; only kAbsolute fits real walks.
  enum class MeanAcceleration {
    kAbsolute,     ///< Mean |linear acceleration|.
    kWithGravity,  ///< Mean of the acceleration with gravity in it.
    kSigned,       ///< Mean linear acceleration, near zero.
  };

  struct Options {
    double constant_m = 0.0;
    double swing_gain = 0.41;  ///< m per (m/s2)^(1/4); [Weinberg2002] K, [Zhou2016] beta.
    double cadence_gain_m_s = 0.0;
    double shortest_m = 0.25;
    double longest_m = 1.2;
    Model model = Model::kThreeTerm;
    double scarlett_gain_m = 1.3;  ///< [Wu2019] eq. (7) K; not given there, > 0.
    double kim_gain = 0.47;        ///< [Wu2019] eq. (8) K; not given there, > 0.
    int kim_root = 3;              ///< 2 as printed.
    StrideGains gains{};           ///< Of kImproved; scale_ratio of all.
    MeanAcceleration mean_acceleration = MeanAcceleration::kAbsolute;
    double height_m = 1.70;     ///< Of the person, for the last three models; [1, 2.5].
    double person_ratio = 1.0;  ///< The person's own factor on those; > 0.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// [Zhao2019] H of kWeinberg, for Options::swing_gain.
  static constexpr double kZhaoSwingGain = 0.3426;

  explicit StrideModel(const Options& options) : options_(options) {}

  /// `previous_interval_s`: duration of the step before, where there was one; kChen smooths with
  /// it.
  double length_m(const Step& step, std::optional<double> previous_interval_s = {}) const;

  void set_gains(const StrideGains& gains) { options_.gains = gains; }

 private:
  double law_m(const Step& step, double previous_interval_s) const;

  Options options_;
};

/// What kImproved's gains are multiplied with, for StrideCalibrator.
observation::StrideFeatures stride_features(const Step& step);

}  // namespace waylode::pdr
