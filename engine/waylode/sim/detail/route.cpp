// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/sim/detail/route.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "waylode/core/angle.hpp"

namespace waylode::sim::detail {

namespace {

using core::FloorId;
using core::Vector2;
using Way = std::vector<Vector2>;

double length_m(const Way& way) {
  double sum_m = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) sum_m += (way[i] - way[i - 1]).norm();
  return sum_m;
}

double turn_rad(const Way& in, const Way& out) {
  const Vector2 a = in.back() - in[in.size() - 2];
  const Vector2 b = out[1] - out[0];
  return std::abs(core::wrap_angle(std::atan2(b.y(), b.x()) - std::atan2(a.y(), a.x())));
}

/// Collects ways into strokes on one floor after another.
class RouteBuilder {
 public:
  RouteBuilder(const Building& building, const std::vector<NavGrid>& grids,
               const GaitOptions& options, core::Rng& rng)
      : building_(building), grids_(grids), options_(options), rng_(rng) {}

  core::Result<void> start(const NamedPoint& place) {
    position_m_ = place.position_m;
    floor_ = place.floor;
    places_.push_back(position_m_);
    return {};
  }

  core::Result<void> go_to(const NamedPoint& place) {
    while (floor_ != place.floor) {
      if (auto climbed = take_stairs(place); !climbed) return climbed;
    }
    auto way = find_way(place.position_m, place.name);
    if (!way) return tl::unexpected(std::move(way.error()));
    if (way->size() < 2) return {};
    walk_with_whims(*way);
    places_.push_back(place.position_m);
    if (rng_.uniform() < options_.pause_probability) {
      end_stroke();
      pause_s_ += options_.pause_s * rng_.uniform(0.5, 1.5);
    }
    return {};
  }

  std::vector<Stroke> finish() {
    end_stroke();
    return std::move(strokes_);
  }

 private:
  core::Result<Way> find_way(const Vector2& to_m, const std::string& name) const {
    if ((to_m - position_m_).norm() < 0.05) return Way{};
    if (options_.straight_ways) return Way{position_m_, to_m};
    auto way = grids_[floor_.index].find_way(position_m_, to_m);
    if (!way) {
      return core::fail(core::ErrorCode::kScenarioInvalid,
                        "no way to '" + name + "' on floor '" + building_.floor(floor_).name +
                            "'; people need gaps of 0.7 m, draw a door (+) or stairs (^)");
    }
    return std::move(*way);
  }

  /// Appends a way that starts where the walker is; turning round ends the stroke before it.
  void walk(const Way& way) {
    constexpr double kTurnRound_rad = 1.9;
    if (way_.size() >= 2 && turn_rad(way_, way) > kTurnRound_rad) end_stroke();
    way_.insert(way_.end(), way.begin() + (way_.empty() ? 0 : 1), way.end());
    position_m_ = way.back();
  }

  /// Now and then goes back a few metres in the middle of a way.
  void walk_with_whims(const Way& way) {
    constexpr double kShortest_m = 10.0;
    const double whole_m = length_m(way);
    const bool turns_back = rng_.uniform() < options_.u_turn_probability && whole_m > kShortest_m;
    if (!turns_back) return walk(way);
    const Path path(way);
    const double until_m = whole_m * rng_.uniform(0.5, 0.8);
    const double back_m = rng_.uniform(3.0, 0.4 * whole_m);
    const auto part = [&](double from_m, double to_m) {
      const int pieces = static_cast<int>(std::ceil(std::abs(to_m - from_m) / 0.25));
      Way result;
      for (int i = 0; i <= pieces; ++i) {
        result.push_back(path.position_m(from_m + (to_m - from_m) * i / pieces));
      }
      return result;
    };
    walk(part(0.0, until_m));
    walk(part(until_m, until_m - back_m));
    walk(part(until_m - back_m, whole_m));
  }

  void end_stroke() {
    if (way_.size() >= 2) {
      Way vertices = resample(way_, NavGrid::kVertexSpacing_m);
      grids_[floor_.index].round_corners(vertices);
      Stroke stroke{Path(vertices), floor_, floor_, pause_s_, {}};
      double arc_m = 0.0;
      for (const Vector2& place : places_) {
        arc_m = stroke.path.nearest_arc_m(place, arc_m);
        stroke.taps_arc_m.push_back(arc_m);
      }
      strokes_.push_back(std::move(stroke));
      places_.clear();
      pause_s_ = 0.0;
    }
    way_.clear();
  }

  /// Goes to the stairs that make the shortest way to `goal` and one storey along them.
  core::Result<void> take_stairs(const NamedPoint& goal) {
    const bool up = goal.floor > floor_;
    const FloorId lower{static_cast<std::uint16_t>(up ? floor_.index : floor_.index - 1)};
    const Stairwell* best = nullptr;
    double best_m = std::numeric_limits<double>::infinity();
    for (const Stairwell& stairs : building_.stairwells) {
      if (stairs.lower != lower) continue;
      const auto way = grids_[floor_.index].find_way(position_m_, stairs.centre_m);
      if (!way) continue;
      const double total_m = length_m(*way) + (stairs.centre_m - goal.position_m).norm();
      if (total_m >= best_m) continue;
      best = &stairs;
      best_m = total_m;
    }
    const FloorId next{static_cast<std::uint16_t>(up ? floor_.index + 1 : floor_.index - 1)};
    if (best == nullptr) {
      return core::fail(core::ErrorCode::kScenarioInvalid,
                        "no stairs lead from floor '" + building_.floor(floor_).name + "' to '" +
                            building_.floor(next).name + "' on the way to '" + goal.name +
                            "'; draw '^' at the same place on both");
    }
    return climb(*best, next);
  }

  core::Result<void> climb(const Stairwell& stairs, FloorId next) {
    const Vector2 away = position_m_ - stairs.centre_m;
    const Vector2 direction = away.norm() > 0.05 ? Vector2(away.normalized()) : Vector2::UnitX();
    const Vector2 foot_m = stairs.centre_m + stairs.radius_m * direction;
    auto way = find_way(foot_m, "stairs");
    if (!way) return tl::unexpected(std::move(way.error()));
    if (way->size() >= 2) walk(*way);
    end_stroke();
    constexpr double kRunPerRise_ratio = 0.28 / 0.17;  // Going and rise of ordinary stairs.
    const double rise_m =
        std::abs(building_.floor(next).elevation_m - building_.floor(floor_).elevation_m);
    const double circle_m = 2.0 * core::kPi * stairs.radius_m;
    const double rounds = std::max(1.0, std::round(rise_m * kRunPerRise_ratio / circle_m));
    const double start_rad = std::atan2(direction.y(), direction.x());
    const int pieces = static_cast<int>(std::ceil(rounds * std::max(circle_m / 0.1, 16.0)));
    Way spiral;
    for (int i = 0; i <= pieces; ++i) {
      const double angle_rad = start_rad + 2.0 * core::kPi * rounds * i / pieces;
      spiral.push_back(stairs.centre_m +
                       stairs.radius_m * Vector2(std::cos(angle_rad), std::sin(angle_rad)));
    }
    strokes_.push_back({Path(spiral), floor_, next, std::exchange(pause_s_, 0.0), {}});
    position_m_ = foot_m;
    floor_ = next;
    return {};
  }

  const Building& building_;
  const std::vector<NavGrid>& grids_;
  const GaitOptions& options_;
  core::Rng& rng_;
  std::vector<Stroke> strokes_;
  FloorId floor_;
  Vector2 position_m_ = Vector2::Zero();
  Way way_;
  std::vector<Vector2> places_;
  double pause_s_ = 0.0;
};

}  // namespace

core::Result<std::vector<Stroke>> plan_route(const Building& building,
                                             const std::vector<NavGrid>& grids,
                                             const std::vector<std::string>& places,
                                             const GaitOptions& options, core::Rng& rng) {
  RouteBuilder builder(building, grids, options, rng);
  for (std::size_t i = 0; i < places.size(); ++i) {
    auto place = building.find_point(places[i]);
    if (!place) return tl::unexpected(std::move(place.error()));
    auto gone = i == 0 ? builder.start(*place) : builder.go_to(*place);
    if (!gone) return tl::unexpected(std::move(gone.error()));
  }
  std::vector<Stroke> strokes = builder.finish();
  if (strokes.empty()) {
    return core::fail(core::ErrorCode::kScenarioInvalid,
                      "a route stays in one place; name at least two different places");
  }
  return strokes;
}

}  // namespace waylode::sim::detail
