// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <deque>
#include <optional>

#include "waylode/core/result.hpp"
#include "waylode/pdr/detail/low_pass.hpp"
#include "waylode/pdr/detail/step_window.hpp"
#include "waylode/pdr/step_source.hpp"

namespace waylode::pdr {

/// Adaptive weighted peak detection [Wu2019]: how the person moves is judged from the last peaks
/// and from how the person moved before, with a weight that decays the longer that has lasted; the
/// threshold of a step follows from it. The figure that defines it is not in the text: bands and
/// weights are ours.
class AdaptivePeakDetector final : public StepSource {
 public:
  enum class Gait { kStill, kSlow, kNormal, kFast, kRun };
  static constexpr std::size_t kGaitCount = 5;

  /// What a gait looks like: height of the smoothed peaks and steps per second, Gaussian.
  struct Band {
    double peak_mps2 = 0.0;
    double peak_sigma_mps2 = 1.0;
    double cadence_hz = 0.0;
    double cadence_sigma_hz = 1.0;
    bool operator==(const Band&) const = default;
  };

  struct Options {
    double low_pass_hz = 3.0;          ///< Cut-off of the smoothing.
    double history_weight = 0.5;       ///< Of the gait before, at its beginning; [0, 1).
    double history_tau_s = 5.0;        ///< The weight decays this fast while the gait lasts; > 0.
    double relative_peak_ratio = 0.5;  ///< Of the gait's mean peak, what a step must reach; (0, 1).
    double noise_peak_mps2 = 0.3;      ///< Peaks below are not looked at; > 0.
    double shortest_interval_s = 0.25;
    double longest_interval_s = 1.5;  ///< A longer pause is standing.
    /// In the order of Gait.
    std::array<Band, kGaitCount> bands = default_bands();

    static std::array<Band, kGaitCount> default_bands();
    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  explicit AdaptivePeakDetector(const Options& options);

  /// Values that are not finite are passed over. The first steps of a walk are told once it is
  /// known for one, one per sample.
  std::optional<Step> add(const StepInput& input) override;
  Gait gait() const { return gait_; }

 private:
  struct Peak {
    core::DeviceTime time;
    double height_mps2 = 0.0;
  };
  void stand_still();
  void take_peak(core::DeviceTime now);
  void judge_gait(core::DeviceTime now);
  bool is_step(const Peak& peak) const;
  std::optional<Step> tell();

  Options options_;
  detail::LowPass low_pass_;
  detail::StepWindow window_;
  std::optional<core::DeviceTime> last_sample_;
  Gait gait_ = Gait::kStill;
  core::DeviceTime gait_since_;
  std::array<double, kGaitCount> mean_peak_mps2_;  ///< Of each gait, begun at its band's.
  std::optional<Peak> rising_;                     ///< Highest of the current excursion above zero.
  std::deque<Peak> recent_;                        ///< The last peaks, whether steps or not.
  std::deque<Step> waiting_;  ///< Steps to be told; while standing, steps that may be.
};

}  // namespace waylode::pdr
