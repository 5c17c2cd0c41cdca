// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "waylode/core/result.hpp"
#include "waylode/core/time.hpp"
#include "waylode/pdr/rhythm.hpp"
#include "waylode/pdr/step_source.hpp"

namespace waylode::pdr {

/// Finds footfalls as the peaks of the acceleration's length that come in a walker's rhythm, so it
/// needs no attitude and serves in the hand, in a pocket, in a bag and on a swinging arm. Nothing
/// is told before a walk is certain, by its rhythm or by a few clear and even peaks; the steps so
/// far are then told at once, one per following sample, each at most `longest_delay_s` old and the
/// time of confirming. Later steps are told about a third of a step after their peak. Samples that
/// are not finite, beyond any phone's range or out of order are passed over; a gap longer than
/// `pause_s` starts anew. Work per sample is bounded.
class CadenceStepDetector : public StepSource {
 public:
  struct Options {
    double low_pass_hz = 3.5;          ///< Cut-off of each of two stages; cadence is below 3 Hz.
    double high_pass_hz = 0.25;        ///< Takes off the sensor's bias and slow turns of the phone.
    double shortest_interval_s = 0.3;  ///< Between steps; shorter are not looked for: running.
    /// Between steps. A longer one is taken for a stride, since a phone in a pocket repeats itself
    /// by strides and those last 0.9 s and more. Raise it for the slow only when no pockets occur.
    double longest_interval_s = 0.85;
    double rhythm_window_s = 3.0;  ///< What the rhythm is told from; two of the longest strides.
    double start_correlation_ratio = 0.7;  ///< Of strides, to begin a walk; handling stays below.
    double stay_correlation_ratio = 0.4;   ///< To go on walking; below the former.
    std::size_t first_steps = 3;       ///< Regular peaks that make a walk; fewer are never told.
    double longest_delay_s = 2.5;      ///< Of the steps that are counted back when a walk begins.
    double min_prominence_mps2 = 0.5;  ///< Of a peak above the valley before it, smoothed.
    /// Even peaks as prominent as this begin a walk while its rhythm is still mixed with what was
    /// before: short walks from stop to stop. Handling the phone gives weaker or uneven ones.
    double clear_prominence_mps2 = 2.0;
    /// Of the recent peaks' prominence, what a new one must reach; weaker ones are the stir after
    /// the last step, or are inferred from the rhythm.
    double relative_prominence_ratio = 0.4;
    double pause_s = 1.5;  ///< A longer interval starts a new walk; caps Step::interval_s.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  explicit CadenceStepDetector(const Options& options) : options_(options) {}

  std::optional<Step> add(const StepInput& input) override;

 private:
  /// Both signals behind the low pass.
  struct Smoothed {
    double norm_mps2 = 0.0;
    double vertical_mps2 = 0.0;
  };
  /// One interval of the even grid to which the samples are brought.
  struct Cell {
    double norm_mps2 = 0.0;  ///< At its end, smoothed, slow parts taken off.
    // Of the smoothed vertical acceleration within it.
    double highest_mps2 = 0.0;
    double lowest_mps2 = 0.0;
    double sum_mps2 = 0.0;
    double abs_sum_mps2 = 0.0;
    std::size_t count = 0;

    void take(double vertical_mps2);
  };
  struct Peak {
    core::DeviceTime time;
    double prominence_mps2 = 0.0;
  };

  void restart(const StepInput& input);
  void smooth(const StepInput& input);
  void close_cells(core::DeviceTime time, const Smoothed& before, double norm_before_mps2);
  void look_for_peak();
  std::size_t reach() const;
  bool is_highest(std::size_t index, std::size_t reach) const;
  Peak peak_at(std::size_t index) const;
  void judge(const Peak& peak);
  std::optional<Rhythm> rhythm_of_clear_peaks() const;
  void begin_walk(const Rhythm& found);
  bool hides_a_step(double span_s, const Rhythm& found) const;
  void tell(core::DeviceTime time);
  std::optional<Step> take_told();

  const Cell& cell(std::size_t index) const { return cells_[index - forgotten_]; }
  std::size_t cell_count() const { return forgotten_ + cells_.size(); }
  core::DeviceTime time_of(std::size_t index) const;
  std::optional<Rhythm> rhythm() const;

  Options options_;
  std::optional<core::DeviceTime> last_sample_;
  Smoothed stage_one_;
  Smoothed stage_two_;
  double slow_mps2_ = 0.0;  ///< What the high pass takes off the norm.

  core::DeviceTime origin_;  ///< End of cell 0.
  std::deque<Cell> cells_;   ///< By time; those that no step can need any more are gone.
  std::size_t forgotten_ = 0;
  Cell open_;
  std::size_t next_candidate_ = 0;
  std::size_t last_peak_cell_ = 0;
  std::deque<Peak> peaks_;  ///< Prominent ones as far back as may be counted.

  bool walking_ = false;
  double interval_s_ = 0.0;       ///< Of the walk at hand.
  double prominence_mps2_ = 0.0;  ///< Running mean over the walk's peaks.
  std::optional<core::DeviceTime> last_step_;
  std::deque<Step> told_;  ///< Granted, not yet handed out.
};

}  // namespace waylode::pdr
