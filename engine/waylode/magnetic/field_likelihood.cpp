// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/magnetic/field_likelihood.hpp"

#include <algorithm>
#include <cmath>

namespace waylode::magnetic {
namespace {

using core::Vector2;
using site::MagneticPoint;

constexpr double kSmallestNode_m = 0.05;
constexpr double kMostNodes = 4'000'000.0;

Vector2 place_of(const MagneticPoint& point) {
  return {static_cast<double>(point.x_m), static_cast<double>(point.y_m)};
}

Vector2 field_of(const MagneticPoint& point) {
  return {static_cast<double>(point.horizontal_ut), static_cast<double>(point.vertical_ut)};
}

/// Mean and spread of all points, the spread widened by what one reading differs anyway.
FieldExpectation floor_at_large(std::span<const MagneticPoint> points, double field_sigma_ut) {
  Vector2 mean_ut = Vector2::Zero();
  for (const MagneticPoint& point : points) mean_ut += field_of(point);
  mean_ut /= static_cast<double>(points.size());
  Vector2 square_ut2 = Vector2::Zero();
  for (const MagneticPoint& point : points) square_ut2 += (field_of(point) - mean_ut).cwiseAbs2();
  square_ut2 /= static_cast<double>(points.size());
  return {mean_ut, square_ut2.array() + field_sigma_ut * field_sigma_ut};
}

/// A node while it is drawn. The field less the floor's mean, so that squares keep their digits.
struct Sum {
  double weight = 0.0;
  Vector2 field_ut = Vector2::Zero();
  Vector2 square_ut2 = Vector2::Zero();
};

/// Half known ground is a mixture of the points' field and the floor at large: its two moments.
FieldExpectation mix(const Sum& sum, const FieldExpectation& floor, double trust_points,
                     double field_sigma_ut) {
  if (sum.weight <= 0.0) return floor;
  const double known = sum.weight / (sum.weight + trust_points);
  const Vector2 local_ut = sum.field_ut / sum.weight;
  const Vector2 scatter_ut2 = (sum.square_ut2 / sum.weight - local_ut.cwiseAbs2()).cwiseMax(0.0);
  const Vector2 local_ut2 = scatter_ut2.cwiseMax(field_sigma_ut * field_sigma_ut);
  return {floor.mean_ut + known * local_ut, known * local_ut2 + (1.0 - known) * floor.variance_ut2 +
                                                known * (1.0 - known) * local_ut.cwiseAbs2()};
}

bool is_positive(double value, double most) { return value > 0.0 && value <= most; }

}  // namespace

core::Result<void> FieldLikelihood::Options::validate() const {
  if (!(node_m >= kSmallestNode_m && reach_m >= node_m && reach_m <= 100.0 &&
        is_positive(kernel_m, 100.0))) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "node_m must be at least 0.05, reach_m from node_m to 100 and kernel_m "
                      "positive and at most 100",
                      "field_likelihood");
  }
  if (!(is_positive(trust_points, 1e6) && is_positive(field_sigma_ut, 1e3) &&
        bias_sigma_ut >= 0.0 && bias_sigma_ut <= 1e3 && is_positive(cap_sigmas, 100.0) &&
        is_positive(correlation_m, 100.0) && is_positive(weight_ratio, 1.0))) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "trust_points, field_sigma_ut, cap_sigmas, correlation_m and weight_ratio "
                      "must be positive, weight_ratio at most 1 and bias_sigma_ut not negative",
                      "field_likelihood");
  }
  return {};
}

FieldLikelihood::FieldLikelihood(std::span<const MagneticPoint> points, const Options& options)
    : options_(options) {
  if (points.empty()) return;
  floor_ = floor_at_large(points, options.field_sigma_ut);
  lay_out(points);
  draw(points);
}

void FieldLikelihood::lay_out(std::span<const MagneticPoint> points) {
  min_m_ = place_of(points.front());
  Vector2 max_m = min_m_;
  for (const MagneticPoint& point : points) {
    min_m_ = min_m_.cwiseMin(place_of(point));
    max_m = max_m.cwiseMax(place_of(point));
  }
  // One node more than points reach: the outermost know nothing and meet what lies beyond them.
  min_m_.array() -= options_.reach_m + options_.node_m;
  max_m.array() += options_.reach_m + options_.node_m;
  const Vector2 size_m = max_m - min_m_;
  node_m_ = std::max({options_.node_m, std::sqrt(size_m.x() / kMostNodes * size_m.y()),
                      size_m.maxCoeff() / kMostNodes});
  columns_ = static_cast<std::size_t>(size_m.x() / node_m_) + 2;
  rows_ = static_cast<std::size_t>(size_m.y() / node_m_) + 2;
  nodes_.resize(rows_ * columns_);
}

void FieldLikelihood::draw(std::span<const MagneticPoint> points) {
  std::vector<Sum> sums(nodes_.size());
  const double reach_m = std::max(options_.reach_m, node_m_);
  const auto index = [&](double offset_m, std::size_t count) {
    return static_cast<std::size_t>(
        std::clamp(offset_m / node_m_, 0.0, static_cast<double>(count - 1)));
  };
  for (const MagneticPoint& point : points) {
    const Vector2 from_m = place_of(point) - min_m_;
    const Vector2 field_ut = field_of(point) - floor_.mean_ut;
    const double sigma_ut = static_cast<double>(point.sigma_ut);
    const std::size_t last_row = index(from_m.y() + reach_m, rows_);
    const std::size_t last_column = index(from_m.x() + reach_m, columns_);
    for (std::size_t row = index(from_m.y() - reach_m, rows_); row <= last_row; ++row) {
      for (std::size_t column = index(from_m.x() - reach_m, columns_); column <= last_column;
           ++column) {
        const Vector2 node_m =
            node_m_ * Vector2(static_cast<double>(column), static_cast<double>(row));
        const double distance_m = (node_m - from_m).norm();
        if (distance_m > reach_m) continue;
        const double kernels = distance_m / options_.kernel_m;
        const double weight = std::exp(-0.5 * kernels * kernels);
        Sum& sum = sums[row * columns_ + column];
        sum.weight += weight;
        sum.field_ut += weight * field_ut;
        sum.square_ut2.array() += weight * (field_ut.array().square() + sigma_ut * sigma_ut);
      }
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const FieldExpectation node =
        mix(sums[i], floor_, options_.trust_points, options_.field_sigma_ut);
    nodes_[i] = {node.mean_ut.cast<float>(), node.variance_ut2.cast<float>()};
  }
}

FieldExpectation FieldLikelihood::expected_at(const Vector2& position_m) const {
  if (nodes_.empty()) return floor_;
  const Vector2 place = (position_m - min_m_) / node_m_;
  // Written so that no number at all is outside too.
  if (!(place.x() >= 0.0 && place.y() >= 0.0 && place.x() < static_cast<double>(columns_ - 1) &&
        place.y() < static_cast<double>(rows_ - 1))) {
    return floor_;
  }
  const auto column = static_cast<std::size_t>(place.x());
  const auto row = static_cast<std::size_t>(place.y());
  const double right = place.x() - static_cast<double>(column);
  const double up = place.y() - static_cast<double>(row);
  const Node* const lower = &nodes_[row * columns_ + column];
  const Node* const upper = lower + columns_;
  const auto between = [&](const auto part) -> Vector2 {
    return (1.0 - up) * ((1.0 - right) * (lower[0].*part).template cast<double>() +
                         right * (lower[1].*part).template cast<double>()) +
           up * ((1.0 - right) * (upper[0].*part).template cast<double>() +
                 right * (upper[1].*part).template cast<double>());
  };
  return {between(&Node::mean_ut), between(&Node::variance_ut2)};
}

BiasedFieldState FieldLikelihood::start() const {
  const double variance_ut2 = options_.bias_sigma_ut * options_.bias_sigma_ut;
  return {Vector2::Zero(), Vector2(variance_ut2, variance_ut2)};
}

double FieldLikelihood::log_likelihood(const LevelField& measured,
                                       const Vector2& position_m) const {
  BiasedFieldState bias = start();
  return update(bias, measured, position_m, options_.correlation_m);
}

double FieldLikelihood::update(BiasedFieldState& bias, const LevelField& measured,
                               const Vector2& position_m, double walked_m) const {
  if (nodes_.empty() || !(walked_m > 0.0)) return 0.0;
  const ReadingWeight weight{
      options_.weight_ratio * std::min(1.0, walked_m / options_.correlation_m),
      options_.cap_sigmas};
  BiasedFieldState at_large = start();
  return bias.update(measured, expected_at(position_m), weight) -
         at_large.update(measured, floor_, weight);
}

}  // namespace waylode::magnetic
