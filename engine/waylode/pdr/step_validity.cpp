// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/step_validity.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "waylode/core/angle.hpp"

namespace waylode::pdr {

double direction_scatter_rad(std::span<const double> headings_rad) {
  if (headings_rad.size() < 2) return 0.0;
  const std::optional<core::CircularMean> mean = core::circular_mean(headings_rad);
  if (!mean) return core::kPi;
  double sum_rad2 = 0.0;
  for (const double heading_rad : headings_rad) {
    const double away_rad = core::wrap_angle(heading_rad - mean->mean_rad);
    sum_rad2 += away_rad * away_rad;
  }
  return std::sqrt(sum_rad2 / static_cast<double>(headings_rad.size()));
}

core::Result<void> StepValidity::Options::validate() const {
  const bool sound = half_window_s > 0.0 && half_window_s <= 10.0 && scatter_rad > 0.0 &&
                     std::isfinite(scatter_rad) && weak_swing_ratio >= 0.0 &&
                     std::isfinite(weak_swing_ratio);
  if (!sound) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "need half_window_s in (0, 10], scatter_rad > 0 and weak_swing_ratio >= 0",
                      "step_validity");
  }
  return excursion.validate();
}

void StepValidity::add_heading(core::DeviceTime time, double heading_rad) {
  if (!std::isfinite(heading_rad)) return;
  if (options_.rule == Rule::kExcursion) return excursions_.add(time, heading_rad);
  directions_.push_back({time, heading_rad});
  // A step is told some time after it was.
  constexpr double kLateness_s = 5.0;
  core::DeviceTime oldest = time - core::from_seconds(kLateness_s);
  if (!waiting_.empty()) oldest = std::min(oldest, waiting_.front().time);
  oldest -= core::from_seconds(options_.half_window_s);
  while (directions_.front().time < oldest) directions_.pop_front();
}

std::optional<StepValidity::Judged> StepValidity::take(core::DeviceTime now) {
  if (waiting_.empty()) return std::nullopt;
  if (options_.rule == Rule::kExcursion) return take_by_excursion(/*is_last=*/false);
  if (now < waiting_.front().time + core::from_seconds(options_.half_window_s)) return std::nullopt;
  return take_rest();
}

std::optional<StepValidity::Judged> StepValidity::take_rest() {
  if (waiting_.empty()) return std::nullopt;
  if (options_.rule == Rule::kExcursion) return take_by_excursion(/*is_last=*/true);
  const Step step = waiting_.front();
  waiting_.pop_front();
  return judge(step);
}

std::optional<StepValidity::Judged> StepValidity::take_by_excursion(bool is_last) {
  const Step step = waiting_.front();
  const auto course = excursions_.judge(step.time, is_last);
  if (!course) return std::nullopt;
  waiting_.pop_front();
  Judged judged{step, Verdict::kWalk, 0.0};
  if (*course == ExcursionJudge::Verdict::kOnCourse) {
    remember_swing(step);
    return judged;
  }
  const std::optional<double> usual_mps2 = usual_swing_mps2();
  const bool is_weak = usual_mps2 && step.swing_mps2 < options_.weak_swing_ratio * *usual_mps2;
  const bool is_aside = *course == ExcursionJudge::Verdict::kAside;
  judged.verdict = is_aside || is_weak ? Verdict::kInPlace : Verdict::kTurn;
  return judged;
}

void StepValidity::remember_swing(const Step& step) {
  constexpr std::size_t kSwingsKept = 51;
  swings_mps2_.push_back(step.swing_mps2);
  if (swings_mps2_.size() > kSwingsKept) swings_mps2_.pop_front();
}

StepValidity::Judged StepValidity::judge(const Step& step) {
  const core::Duration half_window = core::from_seconds(options_.half_window_s);
  std::vector<double> headings_rad;
  for (const Direction& direction : directions_) {
    if (direction.time >= step.time - half_window && direction.time <= step.time + half_window) {
      headings_rad.push_back(direction.heading_rad);
    }
  }
  Judged judged{step, Verdict::kWalk, direction_scatter_rad(headings_rad)};
  if (judged.scatter_rad <= options_.scatter_rad) {
    remember_swing(step);
    return judged;
  }
  const std::optional<double> usual_mps2 = usual_swing_mps2();
  const bool is_weak = usual_mps2 && step.swing_mps2 < options_.weak_swing_ratio * *usual_mps2;
  judged.verdict = options_.rule == Rule::kLiteral || is_weak ? Verdict::kInPlace : Verdict::kTurn;
  return judged;
}

std::optional<double> StepValidity::usual_swing_mps2() const {
  constexpr std::size_t kFewest = 5;  // Fewer steps straight on do not make a person's habit.
  if (swings_mps2_.size() < kFewest) return std::nullopt;
  std::vector<double> sorted(swings_mps2_.begin(), swings_mps2_.end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

}  // namespace waylode::pdr
