// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/magnetic/sequence_matcher.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "waylode/core/covariance.hpp"
#include "waylode/magnetic/detail/msd_search.hpp"

namespace waylode::magnetic {
namespace {

using core::DeviceTime;
using core::Vector2;
using detail::Fit;
using detail::PathField;

constexpr double kLongest_s = 60.0;
constexpr double kFastest_mps = 12.0;  // No walk is faster; bounds what a match costs.

double search_radius_m(const core::Matrix2& covariance_m2,
                       const SequenceMatcher::Options& options) {
  const Eigen::SelfAdjointEigenSolver<core::Matrix2> axes(covariance_m2, Eigen::EigenvaluesOnly);
  return std::clamp(options.search_sigmas * std::sqrt(axes.eigenvalues().maxCoeff()),
                    options.narrowest_search_m, options.widest_search_m);
}

bool is_usable(const SequenceMatcher::Prior& prior) {
  return prior.belief.position_m.allFinite() &&
         core::is_valid_covariance(prior.belief.covariance_m2) &&
         std::isfinite(prior.heading_offset_rad) && std::isfinite(prior.step_scale) &&
         prior.step_scale > 0.0;
}

/// How much of a constant difference counts against a fit when the phone's own part has a Gaussian
/// prior and is integrated out.
double bias_share(double bias_sigma_ut, double field_sigma_ut, double independent_count) {
  const double ratio = bias_sigma_ut / field_sigma_ut;
  return 1.0 / (1.0 + independent_count * ratio * ratio);
}

std::vector<PathField> turned(const std::vector<PathField>& pieces, double turn_rad) {
  const core::Matrix2 turn = Eigen::Rotation2Dd(turn_rad).toRotationMatrix();
  std::vector<PathField> result = pieces;
  for (PathField& piece : result) piece.from_end_m = turn * piece.from_end_m;
  return result;
}

/// The best over all turns.
std::optional<Fit> fit_window(const std::vector<PathField>& pieces, std::size_t piece_count,
                              double walked_m, const FieldGrid& grid,
                              const detail::SearchArea& area,
                              const SequenceMatcher::Options& options) {
  const double independent_count =
      std::clamp(walked_m / options.correlation_m, 1.0, static_cast<double>(pieces.size()));
  const double field_sigma_ut = std::hypot(options.field_sigma_ut, grid.scatter_ut());
  const double share = bias_share(options.bias_sigma_ut, field_sigma_ut, independent_count);
  const auto least_known = static_cast<std::size_t>(
      std::ceil(options.least_known_ratio * static_cast<double>(piece_count)));
  const int turns = static_cast<int>(std::floor(options.largest_turn_rad / options.turn_step_rad));
  std::vector<detail::Trial> trials;
  for (int turn = -turns; turn <= turns; ++turn) {
    const std::vector<detail::Trial> more = detail::try_area(
        turned(pieces, turn * options.turn_step_rad), grid, area, least_known, share);
    trials.insert(trials.end(), more.begin(), more.end());
  }
  return detail::fit_trials(trials, area,
                            {independent_count, field_sigma_ut, options.widest_sigma_m});
}

}  // namespace

core::Result<void> SequenceMatcher::Options::validate() const {
  const bool window_valid = window_s > 0.0 && window_s <= kLongest_s && spacing_m >= 0.05 &&
                            shortest_path_m >= spacing_m && std::isfinite(shortest_path_m) &&
                            least_known_ratio > 0.0 && least_known_ratio <= 1.0;
  const bool search_valid = step_m >= 0.02 && search_sigmas > 0.0 &&
                            narrowest_search_m >= 2.0 * step_m &&
                            widest_search_m >= narrowest_search_m && widest_search_m <= 200.0 &&
                            std::isfinite(search_sigmas);
  const bool turn_valid = largest_turn_rad >= 0.0 && largest_turn_rad <= 3.15 &&
                          turn_step_rad >= 0.01 && std::isfinite(turn_step_rad);
  const bool doubt_valid = bias_sigma_ut >= 0.0 && bias_sigma_ut <= 1e3 && field_sigma_ut >= 0.01 &&
                           field_sigma_ut <= 1e3 && correlation_m >= 0.05 &&
                           std::isfinite(correlation_m) && map_sigma_m >= 0.0 &&
                           map_sigma_m <= widest_sigma_m && widest_sigma_m > 0.0 &&
                           std::isfinite(widest_sigma_m);
  if (!(window_valid && search_valid && turn_valid && doubt_valid)) {
    return core::fail(
        core::ErrorCode::kInvalidOptions,
        "window_s must be at most 60, spacing_m at least 0.05, shortest_path_m at "
        "least spacing_m, least_known_ratio in (0, 1], step_m at least 0.02, searches "
        "from 2 step_m to 200, turns at most pi in steps of at least 0.01, sigmas not "
        "negative and field_sigma_ut at least 0.01",
        "sequence_matcher");
  }
  return {};
}

void SequenceMatcher::add(DeviceTime time, const LevelField& field) {
  const Vector2 field_ut(field.horizontal_ut, field.vertical_ut);
  if (!field_ut.allFinite() || (!field_.empty() && time <= field_.back().time)) return;
  field_.push_back({time, field_ut});
  forget_before(time - core::from_seconds(2.0 * options_.window_s));
}

void SequenceMatcher::add(const observation::MotionDelta& motion) {
  if (!std::isfinite(motion.length_m) || !std::isfinite(motion.heading_rad)) return;
  if (motion.end <= motion.begin) return;
  if (path_.empty()) path_.push_back({motion.begin, Vector2::Zero(), 0.0});
  PathPoint last = path_.back();
  if (motion.end <= last.time) return;
  if (motion.begin > last.time) path_.push_back({motion.begin, last.path_m, last.walked_m});
  last.path_m +=
      motion.length_m * Vector2(std::cos(motion.heading_rad), std::sin(motion.heading_rad));
  last.walked_m += std::abs(motion.length_m);
  path_.push_back({motion.end, last.path_m, last.walked_m});
  forget_before(motion.end - core::from_seconds(2.0 * options_.window_s));
}

void SequenceMatcher::forget_before(DeviceTime time) {
  while (field_.size() > 1 && field_.front().time < time) field_.pop_front();
  // The point before `time` begins the motion that `time` is in.
  while (path_.size() > 1 && path_[1].time <= time) path_.pop_front();
}

SequenceMatcher::PathPoint SequenceMatcher::path_at(DeviceTime time) const {
  const auto after = std::ranges::lower_bound(path_, time, {}, &PathPoint::time);
  if (after == path_.begin()) return path_.front();
  if (after == path_.end()) return path_.back();
  const PathPoint& before = *std::prev(after);
  const double share =
      core::to_seconds(time - before.time) / core::to_seconds(after->time - before.time);
  return {time, before.path_m + share * (after->path_m - before.path_m),
          before.walked_m + share * (after->walked_m - before.walked_m)};
}

std::vector<PathField> SequenceMatcher::pieces_between(DeviceTime begin, DeviceTime end,
                                                       std::size_t piece_count,
                                                       const Prior& prior) const {
  const PathPoint last = path_at(end);
  const core::Matrix2 floor_from_path =
      prior.step_scale * Eigen::Rotation2Dd(prior.heading_offset_rad).toRotationMatrix();
  std::vector<PathField> sums(piece_count);
  std::vector<double> counts(piece_count, 0.0);
  for (auto reading = std::ranges::lower_bound(field_, begin, {}, &FieldReading::time);
       reading != field_.end() && reading->time <= end; ++reading) {
    const PathPoint here = path_at(reading->time);
    const double to_end_m = prior.step_scale * (last.walked_m - here.walked_m);
    const auto piece =
        std::min(static_cast<std::size_t>(to_end_m / options_.spacing_m), piece_count - 1);
    counts[piece] += 1.0;
    sums[piece].from_end_m += floor_from_path * (here.path_m - last.path_m);
    sums[piece].field_ut += reading->field_ut;
  }
  std::vector<PathField> pieces;
  for (std::size_t i = 0; i < piece_count; ++i) {
    if (counts[i] == 0.0) continue;
    pieces.push_back({sums[i].from_end_m / counts[i], sums[i].field_ut / counts[i]});
  }
  return pieces;
}

std::optional<observation::MagneticObservation> SequenceMatcher::match(
    DeviceTime time, const Prior& prior, const FieldGrid& grid) const {
  if (!is_usable(prior) || grid.empty() || path_.size() < 2) return std::nullopt;
  const DeviceTime end = std::min(time, path_.back().time);
  const DeviceTime begin =
      std::max(time - core::from_seconds(options_.window_s), path_.front().time);
  if (end <= begin) return std::nullopt;
  const double walked_m = prior.step_scale * (path_at(end).walked_m - path_at(begin).walked_m);
  // Written so that no number at all is no walk either.
  if (!(walked_m >= options_.shortest_path_m && walked_m <= kFastest_mps * options_.window_s)) {
    return std::nullopt;
  }
  const detail::SearchArea area{prior.belief.position_m,
                                search_radius_m(prior.belief.covariance_m2, options_),
                                options_.step_m};
  const auto piece_count = static_cast<std::size_t>(walked_m / options_.spacing_m) + 1;
  const auto fit = fit_window(pieces_between(begin, end, piece_count, prior), piece_count, walked_m,
                              grid, area, options_);
  if (!fit) return std::nullopt;
  observation::MagneticObservation result;
  result.time = end;
  result.floor = prior.belief.floor;
  result.position_m = fit->best.end_m;
  result.covariance_m2 =
      fit->covariance_m2 + options_.map_sigma_m * options_.map_sigma_m * core::Matrix2::Identity();
  result.mean_square_difference_ut2 = fit->best.mean_square_ut2;
  return result;
}

}  // namespace waylode::magnetic
