// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/sim/detail/nav_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

namespace waylode::sim::detail {

namespace {

using core::Vector2;

double distance_to_segment_m(const Vector2& point, const Vector2& a, const Vector2& b) {
  const Vector2 along = b - a;
  const double squared = along.squaredNorm();
  const double t = squared > 0.0 ? std::clamp((point - a).dot(along) / squared, 0.0, 1.0) : 0.0;
  return (point - a - t * along).norm();
}

}  // namespace

NavGrid::NavGrid(const site::Floor& floor) {
  origin_m_ = floor.bounds.min_m;
  const Vector2 size_m = floor.bounds.size_m();
  columns_ = static_cast<Cell>(std::ceil(std::max(size_m.x(), kCell_m) / kCell_m));
  rows_ = static_cast<Cell>(std::ceil(std::max(size_m.y(), kCell_m) / kCell_m));
  const auto count = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  const site::Plan& plan = floor.plan;
  inside_.assign(count, plan.walkable.empty() ? 1 : 0);
  clearance_m_.assign(count, static_cast<float>(kFarClearance_m));
  for (const site::Polygon& polygon : plan.walkable) {
    mark_inside(polygon.outer, true);
    for (const site::Ring& hole : polygon.holes) mark_inside(hole, false);
    keep_off(polygon);
  }
  for (const site::Polygon& polygon : plan.obstacles) {
    mark_inside(polygon.outer, false);
    keep_off(polygon);
  }
  for (const site::Wall& wall : plan.walls) keep_off(wall.from_m, wall.to_m);
}

void NavGrid::mark_inside(const site::Ring& ring, bool adds) {
  std::vector<double> crossings_m;
  for (Cell row = 0; row < rows_; ++row) {
    const double y_m = origin_m_.y() + (row + 0.5) * kCell_m;
    crossings_m.clear();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vector2& a = ring[i];
      const Vector2& b = ring[(i + 1) % ring.size()];
      if ((a.y() <= y_m) == (b.y() <= y_m)) continue;
      crossings_m.push_back(a.x() + (y_m - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
    std::sort(crossings_m.begin(), crossings_m.end());
    for (std::size_t i = 0; i + 1 < crossings_m.size(); i += 2) {
      const double first = std::ceil((crossings_m[i] - origin_m_.x()) / kCell_m - 0.5);
      const double last = std::ceil((crossings_m[i + 1] - origin_m_.x()) / kCell_m - 0.5);
      const Cell begin = static_cast<Cell>(std::clamp(first, 0.0, double(columns_)));
      const Cell end = static_cast<Cell>(std::clamp(last, 0.0, double(columns_)));
      const auto base = inside_.begin() + static_cast<std::ptrdiff_t>(row) * columns_;
      if (begin < end) std::fill(base + begin, base + end, adds ? 1 : 0);
    }
  }
}

void NavGrid::keep_off(const site::Polygon& polygon) {
  const auto keep_off_ring = [this](const site::Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) keep_off(ring[i], ring[(i + 1) % ring.size()]);
  };
  keep_off_ring(polygon.outer);
  for (const site::Ring& hole : polygon.holes) keep_off_ring(hole);
}

void NavGrid::keep_off(const Vector2& from_m, const Vector2& to_m) {
  const Vector2 margin_m = Vector2::Constant(kFarClearance_m);
  const Vector2 low = (from_m.cwiseMin(to_m) - margin_m - origin_m_) / kCell_m;
  const Vector2 high = (from_m.cwiseMax(to_m) + margin_m - origin_m_) / kCell_m;
  const auto clamp_cell = [](double value, Cell count) {
    return static_cast<Cell>(std::clamp(std::floor(value), 0.0, static_cast<double>(count - 1)));
  };
  for (Cell row = clamp_cell(low.y(), rows_); row <= clamp_cell(high.y(), rows_); ++row) {
    for (Cell column = clamp_cell(low.x(), columns_); column <= clamp_cell(high.x(), columns_);
         ++column) {
      const Cell cell = row * columns_ + column;
      float& clearance_m = clearance_m_[static_cast<std::size_t>(cell)];
      clearance_m = std::min(
          clearance_m, static_cast<float>(distance_to_segment_m(centre_m(cell), from_m, to_m)));
    }
  }
}

NavGrid::Cell NavGrid::cell_at(const Vector2& position_m) const {
  const Vector2 cell = (position_m - origin_m_) / kCell_m;
  if (!(cell.x() >= 0.0 && cell.y() >= 0.0 && cell.x() < columns_ && cell.y() < rows_)) {
    return kOutside;
  }
  return static_cast<Cell>(cell.y()) * columns_ + static_cast<Cell>(cell.x());
}

Vector2 NavGrid::centre_m(Cell cell) const {
  const double column = static_cast<double>(cell % columns_);
  const double row = static_cast<double>(cell / columns_);
  return origin_m_ + kCell_m * Vector2(column + 0.5, row + 0.5);
}

bool NavGrid::is_walkable(const Vector2& position_m) const {
  const Cell cell = cell_at(position_m);
  return cell != kOutside && inside_[static_cast<std::size_t>(cell)] != 0;
}

double NavGrid::clearance_m(const Vector2& position_m) const {
  const Cell cell = cell_at(position_m);
  if (cell == kOutside || inside_[static_cast<std::size_t>(cell)] == 0) return 0.0;
  return static_cast<double>(clearance_m_[static_cast<std::size_t>(cell)]);
}

bool NavGrid::is_passable(Cell cell) const {
  const auto index = static_cast<std::size_t>(cell);
  return inside_[index] != 0 && clearance_m_[index] >= static_cast<float>(kLeastClearance_m);
}

std::optional<NavGrid::Cell> NavGrid::nearest_passable(const Vector2& position_m) const {
  constexpr Cell kReach = 4;
  std::optional<Cell> best;
  double best_m = std::numeric_limits<double>::infinity();
  for (Cell dy = -kReach; dy <= kReach; ++dy) {
    for (Cell dx = -kReach; dx <= kReach; ++dx) {
      const Cell cell = cell_at(position_m + kCell_m * Vector2(dx, dy));
      if (cell == kOutside || !is_passable(cell)) continue;
      const double distance_m = (centre_m(cell) - position_m).norm();
      if (distance_m >= best_m) continue;
      best = cell;
      best_m = distance_m;
    }
  }
  return best;
}

std::vector<NavGrid::Cell> NavGrid::search(Cell from, Cell to) const {
  struct Open {
    float total;
    Cell cell;
    bool operator>(const Open& other) const {
      return total != other.total ? total > other.total : cell > other.cell;
    }
  };
  std::vector<float> cost(inside_.size(), std::numeric_limits<float>::infinity());
  std::vector<Cell> came_from(inside_.size(), kOutside);
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  const Vector2 goal_m = centre_m(to);
  const auto rest = [&](Cell cell) { return static_cast<float>((centre_m(cell) - goal_m).norm()); };
  cost[static_cast<std::size_t>(from)] = 0.0F;
  open.push({rest(from), from});
  while (!open.empty()) {
    const auto [total, cell] = open.top();
    open.pop();
    if (cell == to) break;
    const float here = cost[static_cast<std::size_t>(cell)];
    if (total > here + rest(cell) + 1e-4F) continue;
    const Cell column = cell % columns_;
    const Cell row = cell / columns_;
    const auto passable_at = [&](Cell c, Cell r) {
      return c >= 0 && r >= 0 && c < columns_ && r < rows_ && is_passable(r * columns_ + c);
    };
    for (Cell dy = -1; dy <= 1; ++dy) {
      for (Cell dx = -1; dx <= 1; ++dx) {
        if ((dx == 0 && dy == 0) || !passable_at(column + dx, row + dy)) continue;
        if (!passable_at(column + dx, row) || !passable_at(column, row + dy)) continue;
        const Cell next = cell + dy * columns_ + dx;
        constexpr double kComfortable_m = 0.8;
        const double missing =
            std::max(0.0, kComfortable_m - double(clearance_m_[static_cast<std::size_t>(next)]));
        const double length_m = kCell_m * std::hypot(double(dx), double(dy));
        const auto price = static_cast<float>(length_m * (1.0 + 2.0 * missing));
        if (here + price >= cost[static_cast<std::size_t>(next)]) continue;
        cost[static_cast<std::size_t>(next)] = here + price;
        came_from[static_cast<std::size_t>(next)] = cell;
        open.push({here + price + rest(next), next});
      }
    }
  }
  std::vector<Cell> cells;
  if (from != to && came_from[static_cast<std::size_t>(to)] == kOutside) return cells;
  for (Cell cell = to; cell != kOutside; cell = came_from[static_cast<std::size_t>(cell)]) {
    cells.push_back(cell);
  }
  std::reverse(cells.begin(), cells.end());
  return cells;
}

bool NavGrid::is_clear_line(const Vector2& from_m, const Vector2& to_m, double needed_m) const {
  const double length_m = (to_m - from_m).norm();
  const int pieces = std::max(1, static_cast<int>(std::ceil(length_m / (0.4 * kCell_m))));
  for (int i = 0; i <= pieces; ++i) {
    if (clearance_m(from_m + (to_m - from_m) * (double(i) / pieces)) < needed_m) return false;
  }
  return true;
}

std::optional<std::vector<Vector2>> NavGrid::find_way(const Vector2& from_m,
                                                      const Vector2& to_m) const {
  const auto from = nearest_passable(from_m);
  const auto to = nearest_passable(to_m);
  if (!from || !to) return std::nullopt;
  const std::vector<Cell> cells = search(*from, *to);
  if (cells.empty()) return std::nullopt;
  std::vector<Vector2> all = {from_m};
  for (const Cell cell : cells) all.push_back(centre_m(cell));
  all.push_back(to_m);
  // Each piece reaches as far as it stays about as clear of walls as the way it replaces.
  constexpr double kEasyClearance_m = 0.5;
  constexpr std::size_t kLookAhead = 160;
  std::vector<Vector2> way = {from_m};
  std::size_t begin = 0;
  while (begin + 1 < all.size()) {
    std::size_t end = begin + 1;
    double least_m = std::min(clearance_m(all[begin]), kEasyClearance_m);
    const std::size_t farthest = std::min(all.size(), begin + kLookAhead);
    for (std::size_t next = begin + 2; next < farthest; ++next) {
      least_m = std::min(least_m, clearance_m(all[next - 1]));
      const double needed_m = std::min({least_m, clearance_m(all[next]), kEasyClearance_m});
      if (is_clear_line(all[begin], all[next], std::max(needed_m, kLeastClearance_m))) end = next;
    }
    way.push_back(all[end]);
    begin = end;
  }
  return way;
}

void NavGrid::round_corners(std::vector<Vector2>& vertices_m) const {
  constexpr int kRounds = 80;
  constexpr double kRate = 0.25;
  std::vector<Vector2> before;
  for (int round = 0; round < kRounds; ++round) {
    before = vertices_m;
    for (std::size_t i = 1; i + 1 < before.size(); ++i) {
      const Vector2 moved = before[i] + kRate * (before[i - 1] + before[i + 1] - 2.0 * before[i]);
      const double clearance_after_m = clearance_m(moved);
      if (clearance_after_m >= kLeastClearance_m + 0.05 ||
          clearance_after_m >= clearance_m(before[i])) {
        vertices_m[i] = moved;
      }
    }
  }
}

std::vector<Vector2> resample(const std::vector<Vector2>& way_m, double spacing_m) {
  std::vector<Vector2> result = {way_m.front()};
  for (std::size_t i = 1; i < way_m.size(); ++i) {
    const Vector2 along = way_m[i] - way_m[i - 1];
    const int pieces = static_cast<int>(std::ceil(along.norm() / spacing_m));
    for (int piece = 1; piece <= pieces; ++piece) {
      result.push_back(way_m[i - 1] + along * (double(piece) / pieces));
    }
  }
  return result;
}

}  // namespace waylode::sim::detail
