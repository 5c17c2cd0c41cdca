// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/stride_model.hpp"

#include <algorithm>
#include <cmath>

#include "waylode/pdr/gravity_filter.hpp"

namespace waylode::pdr {
namespace {

using Options = StrideModel::Options;

double swing_root(const Step& step) { return std::pow(std::max(0.0, step.swing_mps2), 0.25); }

double three_term_m(const Options& options, const Step& step) {
  constexpr double kTypicalCadence_hz = 1.9;
  // [Weinberg2002] fourth root of the swing.
  return options.constant_m + options.swing_gain * swing_root(step) +
         options.cadence_gain_m_s * (1.0 / step.interval_s - kTypicalCadence_hz);
}

double scarlett_m(const Options& options, const Step& step) {
  if (!(step.swing_mps2 > 0.0)) return 0.0;
  // [Wu2019] eq. (7).
  return options.scarlett_gain_m * (step.mean_mps2 - step.lowest_mps2) / step.swing_mps2;
}

double kim_m(const Options& options, const Step& step) {
  // [Wu2019] eq. (8) prints a square root; the model it quotes has a cube root.
  const double root =
      options.kim_root == 2 ? std::sqrt(step.mean_abs_mps2) : std::cbrt(step.mean_abs_mps2);
  return options.kim_gain * root;
}

double mean_acceleration_mps2(StrideModel::MeanAcceleration reading, const Step& step) {
  switch (reading) {
    case StrideModel::MeanAcceleration::kAbsolute:
      return step.mean_abs_mps2;
    case StrideModel::MeanAcceleration::kWithGravity:
      return kStandardGravity_mps2 + step.mean_mps2;
    case StrideModel::MeanAcceleration::kSigned:
      return step.mean_mps2;
  }
  return step.mean_abs_mps2;
}

double improved_m(const Options& options, const Step& step) {
  // [Wu2019] eq. (9), [Zhao2019] eq. (15).
  return options.gains.mean_gain * mean_acceleration_mps2(options.mean_acceleration, step) *
             step.interval_s +
         options.gains.swing_gain * swing_root(step);
}

double chen_m(const Options& options, const Step& step, double previous_interval_s) {
  // [Zhong2017] 2.6; its table is lost. [Chen2011] in its place, which has the properties told of
  // the table: near linear in cadence, growing with the height, bounded.
  constexpr double kHeight_m = 1.75;
  constexpr double kCadence_hz = 1.79;
  const double smooth_hz = 1.0 / (0.8 * step.interval_s + 0.2 * previous_interval_s);
  const double cadence_hz = std::clamp(smooth_hz, 1.2, 2.6);
  const double length_m = 0.7 + 0.371 * (options.height_m - kHeight_m) +
                          0.227 * (cadence_hz - kCadence_hz) * options.height_m / kHeight_m;
  return std::clamp(options.person_ratio * length_m, 0.4, 1.1);
}

double table_m(const Options& options, const Step& step) {
  struct Row {
    double below_steps_in_2_s;
    double height_ratio;
  };
  // [Zhao2010] table 2, quoted at second hand.
  constexpr Row kRows[] = {{2.0, 1.0 / 5.0}, {3.0, 1.0 / 4.0}, {4.0, 1.0 / 3.0},
                           {5.0, 1.0 / 2.0}, {6.0, 1.0 / 1.2}, {8.0, 1.0}};
  const double steps_in_2_s = 2.0 / step.interval_s;
  double ratio = 1.2;
  for (const Row& row : kRows) {
    if (steps_in_2_s < row.below_steps_in_2_s) {
      ratio = row.height_ratio;
      break;
    }
  }
  return options.person_ratio * options.height_m * ratio;
}

}  // namespace

core::Result<void> StrideModel::Options::validate() const {
  if (!(swing_gain >= 0.0 && shortest_m > 0.0 && longest_m > shortest_m)) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "need 0 < shortest_m < longest_m and swing_gain >= 0", "stride_model");
  }
  if (!(scarlett_gain_m > 0.0 && kim_gain > 0.0 && (kim_root == 2 || kim_root == 3) &&
        std::isfinite(gains.mean_gain) && std::isfinite(gains.swing_gain) &&
        gains.scale_ratio > 0.0 && height_m >= 1.0 && height_m <= 2.5 && person_ratio > 0.0)) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "need positive gains and ratios, kim_root 2 or 3 and height_m in [1, 2.5]",
                      "stride_model");
  }
  return {};
}

double StrideModel::length_m(const Step& step, std::optional<double> previous_interval_s) const {
  const double length_m =
      options_.gains.scale_ratio * law_m(step, previous_interval_s.value_or(step.interval_s));
  if (!std::isfinite(length_m)) return options_.shortest_m;
  return std::clamp(length_m, options_.shortest_m, options_.longest_m);
}

double StrideModel::law_m(const Step& step, double previous_interval_s) const {
  constexpr double kHeightShare = 0.413;  // A common rule of thumb.
  switch (options_.model) {
    case Model::kThreeTerm:
      return three_term_m(options_, step);
    case Model::kWeinberg:
      return options_.swing_gain * swing_root(step);  // [Wu2019] eq. (6), [Zhao2019] eq. (14).
    case Model::kScarlett:
      return scarlett_m(options_, step);
    case Model::kKim:
      return kim_m(options_, step);
    case Model::kImproved:
      return improved_m(options_, step);
    case Model::kChen:
      return chen_m(options_, step, previous_interval_s);
    case Model::kProportional:
      return options_.person_ratio * kHeightShare * options_.height_m;
    case Model::kTable:
      return table_m(options_, step);
  }
  return options_.shortest_m;
}

observation::StrideFeatures stride_features(const Step& step) {
  return {.swing_root = swing_root(step),
          .mean_abs_time_mps = step.mean_abs_mps2 * step.interval_s};
}

}  // namespace waylode::pdr
