// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/walkability.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "waylode/core/assert.hpp"
#include "waylode/site/detail/cell_grid.hpp"
#include "waylode/site/detail/crossing.hpp"
#include "waylode/site/detail/doorways.hpp"
#include "waylode/site/detail/nearest_cell.hpp"
#include "waylode/site/detail/plan_raster.hpp"
#include "waylode/site/detail/wall_edges.hpp"

namespace waylode::site {
namespace {

using core::Bounds2;
using core::Vector2;
using detail::CellIndex;
using detail::CellMarks;
using detail::RasterFrame;

constexpr double kMaxCoordinate_m = 1e6;
/// How far beyond the bounds the plan is still looked at.
constexpr double kMargin_m = 50.0;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool is_usable(const Vector2& point_m) {
  return (point_m.array().abs() <= kMaxCoordinate_m).all();  // Not for NaN.
}

bool is_usable(const Polygon& polygon) {
  const auto usable = [](const Ring& ring) {
    return std::ranges::all_of(ring, [](const Vector2& vertex) { return is_usable(vertex); });
  };
  return polygon.outer.size() >= 3 && usable(polygon.outer) &&
         std::ranges::all_of(polygon.holes, usable);
}

Plan usable_part(const Plan& plan) {
  const auto usable = [](const Polygon& polygon) { return is_usable(polygon); };
  Plan kept;
  std::ranges::copy_if(plan.walkable, std::back_inserter(kept.walkable), usable);
  std::ranges::copy_if(plan.obstacles, std::back_inserter(kept.obstacles), usable);
  std::ranges::copy_if(plan.walls, std::back_inserter(kept.walls), [](const Wall& wall) {
    return is_usable(wall.from_m) && is_usable(wall.to_m);
  });
  std::ranges::copy_if(plan.doors, std::back_inserter(kept.doors), [](const Door& door) {
    return is_usable(door.position_m) && door.width_m > 0.0 && door.width_m <= kMaxCoordinate_m;
  });
  return kept;
}

/// The smallest box around what is drawn; reversed when nothing is.
Bounds2 extent_of(const Plan& plan) {
  Bounds2 extent{Vector2::Constant(kInfinity), Vector2::Constant(-kInfinity)};
  const auto extend = [&](const Vector2& point_m) {
    extent = {extent.min_m.cwiseMin(point_m), extent.max_m.cwiseMax(point_m)};
  };
  for (const auto* polygons : {&plan.walkable, &plan.obstacles}) {
    for (const Polygon& polygon : *polygons) std::ranges::for_each(polygon.outer, extend);
  }
  for (const Wall& wall : plan.walls) {
    extend(wall.from_m);
    extend(wall.to_m);
  }
  return extent;
}

bool is_usable(const Bounds2& bounds) {
  return is_usable(bounds.min_m) && is_usable(bounds.max_m) &&
         (bounds.min_m.array() <= bounds.max_m.array()).all();
}

/// Where people can be.
Bounds2 usable_bounds(const Bounds2& bounds, const Bounds2& extent) {
  if (is_usable(bounds) && bounds.diagonal_m() > 0.0) return bounds;
  if (is_usable(extent)) return extent;
  return is_usable(bounds) ? bounds : Bounds2{};
}

/// What is rastered: the bounds, and of the plan what lies near them.
Bounds2 raster_bounds(const Bounds2& bounds, const Bounds2& extent) {
  const Vector2 margin_m = Vector2::Constant(kMargin_m);
  return {bounds.min_m.cwiseMin(extent.min_m.cwiseMax(bounds.min_m - margin_m)),
          bounds.max_m.cwiseMax(extent.max_m.cwiseMin(bounds.max_m + margin_m))};
}

CellMarks walkable_cells(const Plan& plan, const RasterFrame& frame) {
  CellMarks marks = frame.marks(plan.walkable.empty());
  for (const Polygon& polygon : plan.walkable) detail::mark_polygon(polygon, true, frame, marks);
  for (const Polygon& polygon : plan.obstacles) detail::mark_polygon(polygon, false, frame, marks);
  for (const Door& door : plan.doors) {
    detail::mark_disc(door.position_m, 0.5 * door.width_m, frame, marks);
  }
  return marks;
}

/// For every cell a distance within which no wall is, whichever of its points one stands at.
std::vector<float> clearances_m(std::span<const Wall> walls, const RasterFrame& frame) {
  CellMarks marks = frame.marks(false);
  for (const Wall& wall : walls) detail::mark_wall(wall, frame, marks);
  const std::vector<CellIndex> nearest = detail::nearest_marked(marks);
  if (nearest.empty()) return {};
  std::vector<float> clearances(nearest.size());
  std::size_t cell = 0;
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column, ++cell) {
      // Boxes of cells are nearer than their centres.
      const double across = std::max(0, std::abs(nearest[cell].column - column) - 1);
      const double along = std::max(0, std::abs(nearest[cell].row - row) - 1);
      const double clear_m = frame.cell_m * std::hypot(across, along);
      clearances[cell] = static_cast<float>(clear_m * (1.0 - 1e-6));
    }
  }
  return clearances;
}

}  // namespace

struct Walkability::Raster {
  struct Cell {
    CellIndex nearest;         ///< The nearest walkable cell.
    float clearance_m = 0.0F;  ///< No wall is nearer.
  };

  Options options;
  bool knows_anything = false;
  bool has_outline = false;  ///< Beyond the raster nobody walks.
  Bounds2 bounds;
  RasterFrame frame;
  std::vector<Cell> cells;  ///< Empty when all is walkable and nothing is in the way.
  std::vector<std::uint32_t> walkable_cells;  ///< With their centre in the bounds.
  std::vector<detail::CellGrid::Segment> walls;
  std::size_t edge_count = 0;  ///< The first ones are edges of areas.
  detail::CellGrid wall_grid;

  struct Place {
    double depth2_m2 = 0.0;
    float clearance_m = 0.0F;
  };
  /// `point_m` is finite.
  Place look_up(const Vector2& point_m) const;
  bool crosses_wall(const Vector2& from_m, const Vector2& to_m, bool between_walkable) const;
  std::size_t clamped_cell(const Vector2& point_m, bool& outside) const;
};

std::size_t Walkability::Raster::clamped_cell(const Vector2& point_m, bool& outside) const {
  const double column = (point_m.x() - frame.min_m.x()) / frame.cell_m;
  const double row = (point_m.y() - frame.min_m.y()) / frame.cell_m;
  const double last_column = frame.columns - 1;
  const double last_row = frame.rows - 1;
  outside = column < 0.0 || row < 0.0 || column >= frame.columns || row >= frame.rows;
  return frame.cell_of(static_cast<int>(std::clamp(column, 0.0, last_column)),
                       static_cast<int>(std::clamp(row, 0.0, last_row)));
}

namespace {

/// Squared distance from the point to the cell's square.
double distance2_m2(const Vector2& point_m, CellIndex cell, const RasterFrame& frame) {
  const Vector2 centre_m = frame.centre_m(cell.column, cell.row);
  const Vector2 beyond_m = (point_m - centre_m).cwiseAbs() - Vector2::Constant(0.5 * frame.cell_m);
  return beyond_m.cwiseMax(0.0).squaredNorm();
}

}  // namespace

Walkability::Raster::Place Walkability::Raster::look_up(const Vector2& point_m) const {
  if (cells.empty()) return {};
  bool outside = false;
  const Cell& cell = cells[clamped_cell(point_m, outside)];
  if (outside) {
    return {has_outline ? distance2_m2(point_m, cell.nearest, frame) : 0.0, 0.0F};
  }
  return {distance2_m2(point_m, cell.nearest, frame), cell.clearance_m};
}

bool Walkability::Raster::crosses_wall(const Vector2& from_m, const Vector2& to_m,
                                       bool between_walkable) const {
  return wall_grid.any_along(from_m, to_m, [&](std::span<const std::uint32_t> items) {
    return std::ranges::any_of(items, [&](std::uint32_t item) {
      const auto& [a, b] = walls[item];
      return (between_walkable || item >= edge_count) && detail::crosses(a, b, from_m, to_m);
    });
  });
}

core::Result<void> Walkability::Options::validate() const {
  const auto check = [](const char* name, double value, double low,
                        double high) -> core::Result<void> {
    if (value >= low && value <= high) return {};
    return core::fail(core::ErrorCode::kInvalidArgument,
                      std::string(name) + " is out of its range; see its comment", "walkability");
  };
  return check("cell_m", cell_m, 0.05, 2.0)
      .and_then([&] { return check("softness_m", softness_m, 0.05, 10.0); })
      .and_then([&] { return check("wall_penalty", wall_penalty, 0.0, 100.0); })
      .and_then([&] { return check("max_penalty", max_penalty, 0.0, 100.0); });
}

Walkability::Walkability(const Plan& plan, const Bounds2& bounds, const Options& options) {
  WAYLODE_ASSERT(options.validate().has_value());
  auto raster = std::make_shared<Raster>();
  const Plan usable = usable_part(plan);
  const Bounds2 extent = extent_of(usable);
  raster->options = options;
  raster->bounds = usable_bounds(bounds, extent);
  raster->frame = RasterFrame::covering(raster_bounds(raster->bounds, extent), options.cell_m);
  const RasterFrame& frame = raster->frame;

  const detail::Barriers barriers = detail::barriers_of(usable);
  std::vector<Wall> walls = detail::without_doorways(barriers.edges, usable.doors);
  raster->edge_count = walls.size();
  std::ranges::copy(detail::without_doorways(barriers.thin_walls, usable.doors),
                    std::back_inserter(walls));
  for (const Wall& wall : walls) raster->walls.emplace_back(wall.from_m, wall.to_m);
  raster->wall_grid = detail::CellGrid::of_segments(raster->walls);

  CellMarks walkable = walkable_cells(usable, frame);
  std::vector<CellIndex> nearest = detail::nearest_marked(walkable);
  raster->has_outline = !usable.walkable.empty() && !nearest.empty();
  if (nearest.empty()) {
    walkable = frame.marks(true);
    nearest = detail::nearest_marked(walkable);
  }
  raster->knows_anything =
      !raster->walls.empty() || std::ranges::find(walkable.marked, 0) != walkable.marked.end();
  const std::vector<float> clearance_m = clearances_m(walls, frame);
  if (raster->knows_anything) {
    raster->cells.resize(nearest.size());
    for (std::size_t cell = 0; cell < nearest.size(); ++cell) {
      raster->cells[cell].nearest = nearest[cell];
      // No wall on the raster: one may still be beyond it.
      raster->cells[cell].clearance_m = clearance_m.empty() ? 0.0F : clearance_m[cell];
    }
  }
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      const std::size_t cell = frame.cell_of(column, row);
      if (walkable.marked[cell] != 0 && raster->bounds.contains(frame.centre_m(column, row))) {
        raster->walkable_cells.push_back(static_cast<std::uint32_t>(cell));
      }
    }
  }
  raster_ = std::move(raster);
}

bool Walkability::knows_anything() const { return raster_->knows_anything; }

double Walkability::log_penalty(const Vector2& from_m, const Vector2& to_m) const {
  const Raster& raster = *raster_;
  const Options& options = raster.options;
  const double step2_m2 = (to_m - from_m).squaredNorm();
  if (!(step2_m2 < kInfinity)) return -options.max_penalty;
  if (raster.cells.empty()) return 0.0;
  const Raster::Place there = raster.look_up(to_m);
  double penalty = 0.5 * there.depth2_m2 / (options.softness_m * options.softness_m);
  const double clear_m = there.clearance_m;
  if (step2_m2 > clear_m * clear_m && !raster.walls.empty() && penalty < options.max_penalty) {
    const bool between_walkable = there.depth2_m2 <= 0.0 && raster.look_up(from_m).depth2_m2 <= 0.0;
    const bool may_count = between_walkable || raster.edge_count < raster.walls.size();
    if (may_count && raster.crosses_wall(from_m, to_m, between_walkable)) {
      penalty += options.wall_penalty;
    }
  }
  return -std::min(penalty, options.max_penalty);
}

double Walkability::depth_m(const Vector2& point_m) const {
  if (!point_m.allFinite()) return kInfinity;
  return std::sqrt(raster_->look_up(point_m).depth2_m2);
}

std::optional<Vector2> Walkability::nearest_walkable(const Vector2& point_m) const {
  if (!point_m.allFinite()) return std::nullopt;
  const Raster& raster = *raster_;
  if (!(raster.look_up(point_m).depth2_m2 > 0.0)) return point_m;
  bool outside = false;
  const CellIndex nearest = raster.cells[raster.clamped_cell(point_m, outside)].nearest;
  const Vector2 centre_m = raster.frame.centre_m(nearest.column, nearest.row);
  const Vector2 half_m = Vector2::Constant(0.5 * raster.frame.cell_m);
  return point_m.cwiseMax(centre_m - half_m).cwiseMin(centre_m + half_m);
}

Vector2 Walkability::sample_walkable(core::Rng& rng) const {
  const Raster& raster = *raster_;
  const auto within = [&](const Vector2& low_m, const Vector2& high_m) {
    const double x_m = rng.uniform(low_m.x(), high_m.x());
    return Vector2(x_m, rng.uniform(low_m.y(), high_m.y()));
  };
  const auto& cells = raster.walkable_cells;
  if (cells.empty()) return within(raster.bounds.min_m, raster.bounds.max_m);
  const Vector2 half_m = Vector2::Constant(0.5 * raster.frame.cell_m);
  for (;;) {
    const int cell = static_cast<int>(cells[rng.below(cells.size())]);
    const Vector2 centre_m =
        raster.frame.centre_m(cell % raster.frame.columns, cell / raster.frame.columns);
    const Vector2 drawn_m = within(centre_m - half_m, centre_m + half_m);
    // At least a quarter of a cell lies within the bounds with its centre.
    if (raster.bounds.contains(drawn_m)) return drawn_m;
  }
}

}  // namespace waylode::site
