// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/magnetic/field_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace waylode::magnetic {
namespace {

using core::Vector2;
using site::MagneticPoint;

constexpr double kSmallestNode_m = 0.05;
constexpr double kMostNodes = 4'000'000.0;
/// Of the bilinear weight at a place, how much must fall on nodes that know their field.
constexpr double kLeastKnown = 0.5;

Vector2 place_of(const MagneticPoint& point) {
  return {static_cast<double>(point.x_m), static_cast<double>(point.y_m)};
}

/// Fewer readings come from one pass of one walk.
constexpr int kSeveral = 4;

double scatter_of(std::span<const MagneticPoint> points) {
  double squares_ut2 = 0.0;
  double count = 0.0;
  for (const MagneticPoint& point : points) {
    if (point.count < kSeveral) continue;
    const double sigma_ut = static_cast<double>(point.sigma_ut);
    squares_ut2 += point.count * sigma_ut * sigma_ut;
    count += point.count - 1;
  }
  return count > 0.0 ? std::sqrt(squares_ut2 / count) : 0.0;
}

/// A node while it is drawn.
struct Sum {
  double weight = 0.0;
  double horizontal_ut = 0.0;
  double vertical_ut = 0.0;
};

}  // namespace

core::Result<void> FieldGrid::Options::validate() const {
  if (!(node_m >= kSmallestNode_m && reach_m >= node_m && reach_m <= 100.0 && kernel_m > 0.0 &&
        kernel_m <= 100.0)) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "node_m must be at least 0.05, reach_m from node_m to 100 and kernel_m "
                      "positive and at most 100",
                      "field_grid");
  }
  return {};
}

FieldGrid::FieldGrid(std::span<const MagneticPoint> points, const Options& options) {
  if (points.empty()) return;
  scatter_ut_ = scatter_of(points);
  lay_out(points, options);
  draw(points, options);
}

void FieldGrid::lay_out(std::span<const MagneticPoint> points, const Options& options) {
  min_m_ = place_of(points.front());
  Vector2 max_m = min_m_;
  for (const MagneticPoint& point : points) {
    min_m_ = min_m_.cwiseMin(place_of(point));
    max_m = max_m.cwiseMax(place_of(point));
  }
  min_m_.array() -= options.reach_m;
  max_m.array() += options.reach_m;
  const Vector2 size_m = max_m - min_m_;
  // Both rows and columns are one more than the quotients; 1 m on every side keeps this positive.
  node_m_ = std::max({options.node_m, std::sqrt(size_m.x() / kMostNodes * size_m.y()),
                      size_m.maxCoeff() / kMostNodes});
  columns_ = static_cast<std::size_t>(size_m.x() / node_m_) + 2;
  rows_ = static_cast<std::size_t>(size_m.y() / node_m_) + 2;
  nodes_.resize(rows_ * columns_);
}

Vector2 FieldGrid::node_at(std::size_t row, std::size_t column) const {
  return min_m_ + node_m_ * Vector2(static_cast<double>(column), static_cast<double>(row));
}

void FieldGrid::draw(std::span<const MagneticPoint> points, const Options& options) {
  std::vector<Sum> sums(nodes_.size());
  const double reach_m = std::max(options.reach_m, node_m_);
  const auto index = [&](double offset_m, std::size_t count) {
    return static_cast<std::size_t>(
        std::clamp(offset_m / node_m_, 0.0, static_cast<double>(count - 1)));
  };
  for (const MagneticPoint& point : points) {
    const Vector2 place_m = place_of(point);
    const Vector2 from_m = place_m - min_m_;
    const std::size_t last_row = index(from_m.y() + reach_m, rows_);
    const std::size_t last_column = index(from_m.x() + reach_m, columns_);
    for (std::size_t row = index(from_m.y() - reach_m, rows_); row <= last_row; ++row) {
      for (std::size_t column = index(from_m.x() - reach_m, columns_); column <= last_column;
           ++column) {
        const double distance_m = (node_at(row, column) - place_m).norm();
        if (distance_m > reach_m) continue;
        const double kernels = distance_m / options.kernel_m;
        const double weight = std::exp(-0.5 * kernels * kernels) + 1e-9;
        Sum& sum = sums[row * columns_ + column];
        sum.weight += weight;
        sum.horizontal_ut += weight * static_cast<double>(point.horizontal_ut);
        sum.vertical_ut += weight * static_cast<double>(point.vertical_ut);
      }
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (sums[i].weight <= 0.0) continue;
    nodes_[i] = {static_cast<float>(sums[i].horizontal_ut / sums[i].weight),
                 static_cast<float>(sums[i].vertical_ut / sums[i].weight), true};
  }
}

std::optional<LevelField> FieldGrid::at(const Vector2& position_m) const {
  if (nodes_.empty()) return std::nullopt;
  const Vector2 place = (position_m - min_m_) / node_m_;
  // Written so that no number at all is outside too.
  if (!(place.x() >= 0.0 && place.y() >= 0.0 && place.x() < static_cast<double>(columns_ - 1) &&
        place.y() < static_cast<double>(rows_ - 1))) {
    return std::nullopt;
  }
  const auto column = static_cast<std::size_t>(place.x());
  const auto row = static_cast<std::size_t>(place.y());
  const double right = place.x() - static_cast<double>(column);
  const double up = place.y() - static_cast<double>(row);
  const Node* const lower = &nodes_[row * columns_ + column];
  const Node* const upper = lower + columns_;
  const std::array<std::pair<const Node*, double>, 4> corners = {
      {{lower, (1.0 - right) * (1.0 - up)},
       {lower + 1, right * (1.0 - up)},
       {upper, (1.0 - right) * up},
       {upper + 1, right * up}}};
  Sum sum;
  for (const auto& [node, weight] : corners) {
    if (!node->known) continue;
    sum.weight += weight;
    sum.horizontal_ut += weight * static_cast<double>(node->horizontal_ut);
    sum.vertical_ut += weight * static_cast<double>(node->vertical_ut);
  }
  if (sum.weight < kLeastKnown) return std::nullopt;
  return LevelField{sum.horizontal_ut / sum.weight, sum.vertical_ut / sum.weight};
}

std::optional<double> FieldGrid::gradient_utpm(const Vector2& position_m) const {
  const auto here = at(position_m);
  if (!here) return std::nullopt;
  double squares = 0.0;
  for (const Vector2& axis : {Vector2(Vector2::UnitX()), Vector2(Vector2::UnitY())}) {
    const auto ahead = at(position_m + node_m_ * axis);
    const auto behind = at(position_m - node_m_ * axis);
    if (!ahead && !behind) continue;  // A line of single points says nothing across it.
    const double span_m = ahead && behind ? 2.0 * node_m_ : node_m_;
    const LevelField high = ahead.value_or(*here);
    const LevelField low = behind.value_or(*here);
    const double horizontal = (high.horizontal_ut - low.horizontal_ut) / span_m;
    const double vertical = (high.vertical_ut - low.vertical_ut) / span_m;
    squares += horizontal * horizontal + vertical * vertical;
  }
  return std::sqrt(squares);
}

std::vector<FieldGrid> field_grids(const site::MagneticMap& map, std::size_t floor_count,
                                   const FieldGrid::Options& options) {
  std::vector<FieldGrid> grids;
  grids.reserve(floor_count);
  for (std::size_t i = 0; i < floor_count; ++i) {
    grids.emplace_back(map.on_floor(core::FloorId{static_cast<std::uint16_t>(i)}), options);
  }
  return grids;
}

}  // namespace waylode::magnetic
