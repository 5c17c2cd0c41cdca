// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "waylode/core/angle.hpp"
#include "waylode/pipeline/detail/option_table.hpp"

namespace waylode::pipeline::detail {
namespace {

void visit_cadence(pdr::CadenceStepDetector::Options& cadence, const Visit& visit) {
  Table("pdr.cadence", visit)
      .number("low_pass_hz", cadence.low_pass_hz, kAboveZero, 1000.0, "Cut-off of the smoothing.")
      .number("high_pass_hz", cadence.high_pass_hz, kAboveZero, 1000.0,
              "Takes off the sensor's bias and slow turns of the phone.")
      .number("shortest_interval_s", cadence.shortest_interval_s, kAboveZero, 10.0,
              "Between two steps.")
      .number("longest_interval_s", cadence.longest_interval_s, kAboveZero, 10.0,
              "A longer one is taken for a stride.")
      .number("rhythm_window_s", cadence.rhythm_window_s, kAboveZero, 60.0,
              "What the rhythm is told from.")
      .number("start_correlation_ratio", cadence.start_correlation_ratio, 0.0, 1.0,
              "Of strides, to begin a walk.")
      .number("stay_correlation_ratio", cadence.stay_correlation_ratio, 0.0, 1.0,
              "Of strides, to go on walking.")
      .number("first_steps", cadence.first_steps, 1, 100, "Regular peaks that make a walk.")
      .number("longest_delay_s", cadence.longest_delay_s, kAboveZero, 60.0,
              "Of the steps that are counted back when a walk begins.")
      .number("min_prominence_mps2", cadence.min_prominence_mps2, kAboveZero, 100.0,
              "Of a peak above the valley before it.")
      .number("clear_prominence_mps2", cadence.clear_prominence_mps2, kAboveZero, 100.0,
              "Even peaks this prominent begin a walk before the rhythm is clear.")
      .number("relative_prominence_ratio", cadence.relative_prominence_ratio, 0.0, 1.0,
              "Of the recent peaks' prominence, what a new one must reach.")
      .number("pause_s", cadence.pause_s, kAboveZero, 60.0, "A longer pause starts a new walk.");
}

void visit_adaptive_peaks(pdr::AdaptivePeakDetector::Options& peaks, const Visit& visit) {
  const Table table("pdr.adaptive_peaks", visit);
  table.number("low_pass_hz", peaks.low_pass_hz, kAboveZero, 1000.0, "Cut-off of the smoothing.")
      .number("history_weight", peaks.history_weight, 0.0, 0.999,
              "Of the state of motion before, at its beginning.")
      .number("history_tau_s", peaks.history_tau_s, kAboveZero, kHuge,
              "That weight decays this fast while the state lasts.")
      .number("relative_peak_ratio", peaks.relative_peak_ratio, kAboveZero, 0.999,
              "Of the state's mean peak, what a step must reach.")
      .number("noise_peak_mps2", peaks.noise_peak_mps2, kAboveZero, 100.0,
              "Lower peaks are not looked at.")
      .number("shortest_interval_s", peaks.shortest_interval_s, 0.0, 10.0, "Between two steps.")
      .number("longest_interval_s", peaks.longest_interval_s, kAboveZero, 60.0,
              "A longer pause is standing.");
  constexpr std::size_t kCount = pdr::AdaptivePeakDetector::kGaitCount;
  static constexpr std::array<std::array<std::string_view, 4>, kCount> kNames = {
      {{"still_peak_mps2", "still_peak_sigma_mps2", "still_cadence_hz", "still_cadence_sigma_hz"},
       {"slow_peak_mps2", "slow_peak_sigma_mps2", "slow_cadence_hz", "slow_cadence_sigma_hz"},
       {"normal_peak_mps2", "normal_peak_sigma_mps2", "normal_cadence_hz",
        "normal_cadence_sigma_hz"},
       {"fast_peak_mps2", "fast_peak_sigma_mps2", "fast_cadence_hz", "fast_cadence_sigma_hz"},
       {"run_peak_mps2", "run_peak_sigma_mps2", "run_cadence_hz", "run_cadence_sigma_hz"}}};
  for (std::size_t i = 0; i < kCount; ++i) {
    pdr::AdaptivePeakDetector::Band& band = peaks.bands[i];
    table.number(kNames[i][0], band.peak_mps2, 0.0, 100.0, "Mean peak of this state of motion.")
        .number(kNames[i][1], band.peak_sigma_mps2, kAboveZero, 100.0, "Its spread.")
        .number(kNames[i][2], band.cadence_hz, 0.0, 10.0, "Cadence of this state of motion.")
        .number(kNames[i][3], band.cadence_sigma_hz, kAboveZero, 10.0, "Its spread.");
  }
}

void visit_other_detectors(pdr::DeadReckoning::Options& pdr, const Visit& visit) {
  Table("pdr.gaussian_peaks", visit)
      .number("window_s", pdr.gaussian_peaks.window_s, kAboveZero, 5.0,
              "Of the smoothing; longer erases fast steps.")
      .number("min_peak_mps2", pdr.gaussian_peaks.min_peak_mps2, kAboveZero, 100.0,
              "Lower peaks are no steps.")
      .number("sample_interval_s", pdr.gaussian_peaks.sample_interval_s, 0.0, 10.0,
              "Take one sample per so many seconds; 0 takes all, 0.2 is the paper's word.")
      .number("shortest_interval_s", pdr.gaussian_peaks.shortest_interval_s, 0.0, 10.0,
              "Between two steps; 0 takes every peak for a step.")
      .number("longest_interval_s", pdr.gaussian_peaks.longest_interval_s, kAboveZero, 60.0,
              "A longer pause starts a new walk.");
  static constexpr std::array<std::string_view, 2> kWords = {"off", "on"};
  const auto on_off = [](bool& target) {
    return Choice{kWords, [&target] { return target ? std::size_t{1} : std::size_t{0}; },
                  [&target](std::size_t index) { target = index == 1; }};
  };
  Table("pdr.extrema", visit)
      .number("peak_threshold_mps2", pdr.extrema.peak_threshold_mps2, -100.0, 100.0,
              "A step rises above it; calibrate it by a walk with counted steps.")
      .number("trough_threshold_mps2", pdr.extrema.trough_threshold_mps2, -100.0, 100.0,
              "And falls below it.")
      .choice("hysteresis", on_off(pdr.extrema.hysteresis),
              "On: whatever lies between; off: peak and trough must follow each other at once.")
      .number("longest_interval_s", pdr.extrema.longest_interval_s, kAboveZero, 60.0,
              "A longer pause starts a new walk.")
      .number("interval_s", pdr.extrema.decimator.interval_s, kAboveZero, 10.0,
              "Between two values of the thinned signal.")
      .choice("anti_alias", on_off(pdr.extrema.decimator.anti_alias),
              "Average before thinning; off is the paper's word.");
  Table("pdr.step_validity", visit)
      .number("half_window_s", pdr.step_validity.half_window_s, kAboveZero, 10.0,
              "Before and behind a step, where its direction is looked at.")
      .number("scatter_rad", pdr.step_validity.scatter_rad, kAboveZero, core::kPi,
              "A wider scatter of direction is a turn or a step on the spot.")
      .number("weak_swing_ratio", pdr.step_validity.weak_swing_ratio, 0.0, 10.0,
              "Of the person's median swing, below which such a step does not move.");
  pdr::ExcursionJudge::Options& excursion = pdr.step_validity.excursion;
  Table("pdr.excursion", visit)
      .number("leave_rad", excursion.leave_rad, kAboveZero, core::kPi,
              "So far off the course may be a look aside.")
      .number("return_rad", excursion.return_rad, kAboveZero, core::kPi,
              "It ends, and began, where it was no farther than this.")
      .number("settle_s", excursion.settle_s, kAboveZero, 60.0,
              "So long on one new course makes a turn.")
      .number("settled_rad", excursion.settled_rad, kAboveZero, core::kPi,
              "Scatter of a steady course.")
      .number("longest_s", excursion.longest_s, kAboveZero, 60.0,
              "Whoever is not back by then has turned.");
}

void visit_compass(pdr::CompassHeadingFilter::Options& compass, const Visit& visit) {
  Table("pdr.compass", visit)
      .number("gyro_noise_rad_per_sqrt_s", compass.gyro_noise_rad_per_sqrt_s, kAboveZero, kHuge,
              "Drift of the gyroscope's heading, a random walk.")
      .number("initial_bias_sigma_radps", compass.initial_bias_sigma_radps, kAboveZero, kHuge,
              "Doubt of the gyroscope's bias at the start.")
      .number("bias_walk_radps_per_sqrt_s", compass.bias_walk_radps_per_sqrt_s, 0.0, kHuge,
              "How fast the gyroscope's bias wanders.")
      .number("compass_interval_s", compass.compass_interval_s, 0.0, kHuge,
              "The compass is asked at most this often.")
      .number("compass_sigma_rad", compass.compass_sigma_rad, kAboveZero, kHuge,
              "Of one compass heading in an undisturbed field.")
      .number("correlation_s", compass.correlation_s, 0.0, kHuge,
              "Compass headings within this time err alike.")
      .number("field_ut", compass.field_ut, 0.0, 100.0,
              "The earth's field; 0 takes the mean of the first two seconds.")
      .number("dip_rad", compass.dip_rad, -core::kPi, core::kPi,
              "The earth's, used where field_ut is set.")
      .number("field_tolerance_ut", compass.field_tolerance_ut, kAboveZero, kHuge,
              "This far off, the compass counts half.")
      .number("dip_tolerance_rad", compass.dip_tolerance_rad, kAboveZero, kHuge,
              "The same for the dip.")
      .number("gate_sigmas", compass.gate_sigmas, kAboveZero, kHuge,
              "Compass headings further off are not used.")
      .number("lost_after_s", compass.lost_after_s, kAboveZero, kHuge,
              "After so long without a usable one, starts afresh.")
      .number("declination_rad", compass.declination_rad, -core::kPi, core::kPi,
              "Magnetic north, east of true north.");
}

void visit_stride_laws(pdr::StrideModel::Options& stride, const Visit& visit) {
  static constexpr std::array<std::string_view, 3> kMeans = {"absolute", "with_gravity", "signed"};
  const Choice mean = {
      kMeans, [&stride] { return static_cast<std::size_t>(stride.mean_acceleration); },
      [&stride](std::size_t index) {
        stride.mean_acceleration = static_cast<pdr::StrideModel::MeanAcceleration>(index);
      }};
  Table("pdr.stride_laws", visit)
      .number("mean_gain", stride.gains.mean_gain, -10.0, 10.0,
              "K1 of stride=improved; the person's own is learnt on line.")
      .number("improved_swing_gain", stride.gains.swing_gain, -10.0, 10.0,
              "K2 of stride=improved, m per (m/s2)^(1/4).")
      .number("scale_ratio", stride.gains.scale_ratio, kAboveZero, 10.0, "Of every length.")
      .choice("mean_acceleration", mean, "Which mean stride=improved takes.")
      .number("scarlett_gain_m", stride.scarlett_gain_m, kAboveZero, 100.0, "Of stride=scarlett.")
      .number("kim_gain", stride.kim_gain, kAboveZero, 100.0, "Of stride=kim.")
      .number("kim_root", stride.kim_root, 2, 3, "3; 2 is the paper's word.")
      .number("height_m", stride.height_m, 1.0, 2.5,
              "Of the person, for stride=chen, proportional and table.")
      .number("person_ratio", stride.person_ratio, kAboveZero, 10.0,
              "The person's own factor on those.");
}

}  // namespace

void visit_gait_options(Options& options, const Visit& visit) {
  visit_stride_laws(options.pdr.stride, visit);
  visit_cadence(options.pdr.cadence, visit);
  visit_adaptive_peaks(options.pdr.adaptive_peaks, visit);
  visit_other_detectors(options.pdr, visit);
  visit_compass(options.pdr.compass, visit);
}

}  // namespace waylode::pipeline::detail
