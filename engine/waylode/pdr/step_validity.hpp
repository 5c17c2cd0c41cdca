// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>
#include <span>

#include "waylode/core/result.hpp"
#include "waylode/pdr/excursion_judge.hpp"
#include "waylode/pdr/step_source.hpp"

namespace waylode::pdr {

/// Does a step move the person, or is it one of turning round and taking photographs? After
/// [Zhong2017] 2.5: the direction's scatter around the step tells. Steps wait until the window
/// behind them is full.
class StepValidity {
 public:
  enum class Rule {
    /// Any step during a turn is thrown away, as printed: loses those of every corner.
    kLiteral,
    /// Only where the step is weak as well, for this person, was it one in place.
    kThreeWay,
    /// Only where the walker came back to the course soon, or the step is weak on a turn; waits for
    /// the coming back. See ExcursionJudge.
    kExcursion,
  };
  enum class Verdict { kWalk, kTurn, kInPlace };

  struct Options {
    Rule rule = Rule::kThreeWay;
    double half_window_s = 0.75;     ///< Before and behind the step, (0, 10].
    double scatter_rad = 0.34907;    ///< 20 degrees; 15 finds more photographs; > 0.
    double weak_swing_ratio = 0.75;  ///< Of the person's median swing, below which a step is weak.
    ExcursionJudge::Options excursion{};  ///< Of kExcursion, which has no use for scatter_rad.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  struct Judged {
    Step step;
    Verdict verdict = Verdict::kWalk;
    double scatter_rad = 0.0;
  };

  explicit StepValidity(const Options& options)
      : options_(options), excursions_(options.excursion) {}

  /// Headings and steps in order of time, each of its own. Values that are not finite are passed
  /// over.
  void add_heading(core::DeviceTime time, double heading_rad);
  void add_step(const Step& step) { waiting_.push_back(step); }

  /// The oldest step whose window is full at `now`, if there is one; ask until there is none.
  std::optional<Judged> take(core::DeviceTime now);
  /// The oldest step that still waits, judged by what there is; for the end of a recording.
  std::optional<Judged> take_rest();

 private:
  Judged judge(const Step& step);
  std::optional<Judged> take_by_excursion(bool is_last);
  void remember_swing(const Step& step);
  std::optional<double> usual_swing_mps2() const;

  struct Direction {
    core::DeviceTime time;
    double heading_rad = 0.0;
  };
  Options options_;
  ExcursionJudge excursions_;
  std::deque<Direction> directions_;
  std::deque<Step> waiting_;
  std::deque<double> swings_mps2_;  ///< Of the last steps straight on.
};

/// [Zhong2017] eq. (8) on the circle: root mean square deviation from the circular mean. Zero of
/// less than two directions, pi where they cancel.
double direction_scatter_rad(std::span<const double> headings_rad);

}  // namespace waylode::pdr
