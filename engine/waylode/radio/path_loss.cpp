// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/path_loss.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "waylode/core/assert.hpp"

namespace waylode::radio {
namespace {

constexpr double kNearest_m = 0.01;  // Closer than any antenna gets to another.

double decades(double distance_m, double reference_distance_m) {
  return std::log10(std::max(distance_m, kNearest_m) / reference_distance_m);
}

/// Sums for a straight line over decades of distance.
struct Line {
  double intercept_dbm = 0.0;
  double exponent = 0.0;
  double square_sum = 0.0;  ///< Of the residuals.
};

struct Sample {
  double decades = 0.0;
  double rssi_dbm = 0.0;
};

/// nullopt when all lie at one distance.
std::optional<Line> fit_line(std::span<const Sample> samples, double min_exponent,
                             double max_exponent) {
  if (samples.empty()) return std::nullopt;
  const auto count = static_cast<double>(samples.size());
  Sample mean;
  for (const Sample& sample : samples) {
    mean.decades += sample.decades / count;
    mean.rssi_dbm += sample.rssi_dbm / count;
  }
  double square = 0.0;
  double product = 0.0;
  for (const Sample& sample : samples) {
    square += (sample.decades - mean.decades) * (sample.decades - mean.decades);
    product += (sample.decades - mean.decades) * (sample.rssi_dbm - mean.rssi_dbm);
  }
  constexpr double kSameDistance = 1e-12;
  if (!(square > kSameDistance * count)) return std::nullopt;
  Line line;
  line.exponent = std::clamp(-0.1 * product / square, min_exponent, max_exponent);
  line.intercept_dbm = mean.rssi_dbm + 10.0 * line.exponent * mean.decades;
  for (const Sample& sample : samples) {
    const double residual =
        sample.rssi_dbm - (line.intercept_dbm - 10.0 * line.exponent * sample.decades);
    line.square_sum += residual * residual;
  }
  return line;
}

std::vector<PlacedReading> finite_of(std::span<const PlacedReading> readings) {
  std::vector<PlacedReading> finite;
  for (const PlacedReading& reading : readings) {
    if (reading.position_m.allFinite() && std::isfinite(reading.rssi_dbm)) {
      finite.push_back(reading);
    }
  }
  return finite;
}

core::Bounds2 bounds_of(std::span<const PlacedReading> readings) {
  core::Bounds2 box{readings.front().position_m, readings.front().position_m};
  for (const PlacedReading& reading : readings) {
    box.min_m = box.min_m.cwiseMin(reading.position_m);
    box.max_m = box.max_m.cwiseMax(reading.position_m);
  }
  return box;
}

/// A place of the transmitter with the law that serves it best.
struct Hypothesis {
  core::Vector2 position_m;
  Line line;
};

double slant_m(const core::Vector2& from_m, const core::Vector2& to_m, double height_m) {
  return std::sqrt((from_m - to_m).squaredNorm() + height_m * height_m);
}

std::optional<Hypothesis> with_best_law(std::span<const PlacedReading> readings,
                                        const core::Vector2& position_m,
                                        const TransmitterLocator::Options& options) {
  std::vector<Sample> samples;
  samples.reserve(readings.size());
  for (const PlacedReading& reading : readings) {
    samples.push_back({decades(slant_m(reading.position_m, position_m, options.height_m), 1.0),
                       reading.rssi_dbm});
  }
  const auto line = fit_line(samples, options.min_exponent, options.max_exponent);
  if (!line) return std::nullopt;
  return Hypothesis{position_m, *line};
}

/// The Gauss-Newton step of place, level and exponent together; its part of the place.
core::Vector2 step_of(std::span<const PlacedReading> readings, const Hypothesis& at,
                      double height_m) {
  constexpr double kDamping = 1e-9;  // Keeps the system solvable where the exponent is at a bound.
  Eigen::Matrix4d normal = kDamping * Eigen::Matrix4d::Identity();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  for (const PlacedReading& reading : readings) {
    const core::Vector2 away_m = at.position_m - reading.position_m;
    const double square_m2 = away_m.squaredNorm() + height_m * height_m;
    const double decade = decades(std::sqrt(square_m2), 1.0);
    Eigen::Vector4d slope;
    slope << -10.0 * at.line.exponent / std::numbers::ln10 / square_m2 * away_m, 1.0,
        -10.0 * decade;
    const double residual =
        reading.rssi_dbm - (at.line.intercept_dbm - 10.0 * at.line.exponent * decade);
    normal += slope * slope.transpose();
    right += slope * residual;
  }
  const Eigen::Vector4d step = normal.ldlt().solve(right);
  return step.head<2>();
}

/// A grid over the box and the loudest place, the best few first: close to a reading the sum of
/// squares has dips of its own.
std::vector<Hypothesis> starts_of(std::span<const PlacedReading> readings, const core::Bounds2& box,
                                  const TransmitterLocator::Options& options) {
  constexpr std::size_t kStarts = 8;
  std::vector<Hypothesis> starts;
  const auto last = static_cast<double>(options.grid - 1);
  for (std::size_t i = 0; i < options.grid; ++i) {
    for (std::size_t j = 0; j < options.grid; ++j) {
      const core::Vector2 share(static_cast<double>(i) / last, static_cast<double>(j) / last);
      const auto start =
          with_best_law(readings, box.min_m + share.cwiseProduct(box.size_m()), options);
      if (start) starts.push_back(*start);
    }
  }
  std::ranges::stable_sort(starts, {}, [](const Hypothesis& h) { return h.line.square_sum; });
  if (starts.size() > kStarts) starts.erase(starts.begin() + kStarts, starts.end());
  const auto loudest = std::ranges::max_element(readings, {}, &PlacedReading::rssi_dbm);
  const auto above = with_best_law(readings, loudest->position_m, options);
  if (above) starts.push_back(*above);
  return starts;
}

/// Steps that do not help are halved a few times; then the place stands.
Hypothesis refined(std::span<const PlacedReading> readings, Hypothesis best,
                   const core::Bounds2& box, const TransmitterLocator::Options& options) {
  constexpr int kHalvings = 8;
  constexpr double kStill_m = 1e-6;
  for (std::size_t i = 0; i < options.iterations; ++i) {
    core::Vector2 step_m = step_of(readings, best, options.height_m);
    bool better = false;
    for (int halving = 0; halving < kHalvings && !better; ++halving, step_m *= 0.5) {
      const core::Vector2 place_m =
          (best.position_m + step_m).cwiseMax(box.min_m).cwiseMin(box.max_m);
      const auto next = with_best_law(readings, place_m, options);
      better = next && next->line.square_sum < best.line.square_sum;
      if (better) best = *next;
    }
    if (!better || step_m.norm() < kStill_m) break;
  }
  return best;
}

}  // namespace

double PathLoss::mean_dbm(double distance_m) const {
  return reference_dbm - 10.0 * exponent * decades(distance_m, reference_distance_m);
}

std::optional<double> PathLoss::distance_m(double rssi_dbm) const {
  if (!(exponent > 0.0)) return std::nullopt;
  const double distance =
      reference_distance_m * std::pow(10.0, (reference_dbm - rssi_dbm) / (10.0 * exponent));
  if (!std::isfinite(distance)) return std::nullopt;
  return distance;
}

// [Zhao2019] eq. (18)
std::optional<PathLossFit> fit_path_loss(std::span<const DistanceReading> readings,
                                         double reference_distance_m) {
  WAYLODE_ASSERT(reference_distance_m > 0.0);
  std::vector<Sample> samples;
  for (const DistanceReading& reading : readings) {
    if (std::isfinite(reading.distance_m) && reading.distance_m >= 0.0 &&
        std::isfinite(reading.rssi_dbm)) {
      samples.push_back({decades(reading.distance_m, reference_distance_m), reading.rssi_dbm});
    }
  }
  constexpr double kAny = 1e6;
  const auto line = fit_line(samples, -kAny, kAny);
  if (!line) return std::nullopt;
  PathLossFit fit{{reference_distance_m, line->intercept_dbm, line->exponent}, 0.0, samples.size()};
  if (samples.size() > 2) {
    fit.sigma_db = std::sqrt(line->square_sum / static_cast<double>(samples.size() - 2));
  }
  return fit;
}

core::Result<void> TransmitterLocator::Options::validate() const {
  const auto refuse = [](const char* message) {
    return core::fail(core::ErrorCode::kInvalidOptions, message, "transmitter_locator");
  };
  if (!(min_exponent >= 0.0 && max_exponent >= min_exponent && max_exponent <= 10.0)) {
    return refuse("exponents must be in [0, 10], the least first");
  }
  if (!(margin_m >= 0.0 && margin_m <= 1000.0)) return refuse("margin_m must be in [0, 1000]");
  if (!(height_m > 0.0 && height_m <= 100.0)) return refuse("height_m must be in (0, 100]");
  if (grid < 2 || grid > 100 || iterations > 1000) {
    return refuse("grid must be in [2, 100] and iterations at most 1000");
  }
  return {};
}

std::optional<TransmitterFit> TransmitterLocator::fit(
    std::span<const PlacedReading> readings) const {
  WAYLODE_ASSERT(options_.validate().has_value());
  constexpr std::size_t kUnknowns = 4;  // Place, level, exponent.
  const std::vector<PlacedReading> finite = finite_of(readings);
  if (finite.size() <= kUnknowns) return std::nullopt;
  core::Bounds2 box = bounds_of(finite);
  if (!(box.diagonal_m() > 0.0)) return std::nullopt;
  box.min_m.array() -= options_.margin_m;
  box.max_m.array() += options_.margin_m;

  std::optional<Hypothesis> best;
  for (const Hypothesis& start : starts_of(finite, box, options_)) {
    const Hypothesis end = refined(finite, start, box, options_);
    if (!best || end.line.square_sum < best->line.square_sum) best = end;
  }
  if (!best) return std::nullopt;
  const auto freedom = static_cast<double>(finite.size() - kUnknowns);
  return TransmitterFit{best->position_m,
                        {1.0, best->line.intercept_dbm, best->line.exponent},
                        std::sqrt(best->line.square_sum / freedom),
                        finite.size()};
}

}  // namespace waylode::radio
