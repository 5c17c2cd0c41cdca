// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/id.hpp"
#include "waylode/core/rng.hpp"
#include "waylode/sim/building.hpp"
#include "waylode/sim/detail/route.hpp"
#include "waylode/sim/options.hpp"

namespace waylode::sim::detail {

/// A person's constants.
struct Person {
  double height_m = 1.72;
  double cadence_hz = 1.85;
  double step_scale_ratio = 1.0;
  double bounce_constant = 0.42;
};
Person draw_person(const GaitOptions& options, core::Rng& rng);

/// Step length at a cadence by Chen's law times the personal factor (docs/simulator.md, Gait).
double step_length_m(const Person& person, double cadence_hz);

/// A person at one instant.
struct BodyState {
  core::FloorId floor;
  core::Vector2 position_m = core::Vector2::Zero();
  double elevation_m = 0.0;  ///< Of the floor under the feet, site frame.
  double heading_rad = 0.0;  ///< Continuous in time, so not wrapped.
  double speed_mps = 0.0;
  /// Steps done, with the part of the present one: whole at heel strikes, still while standing.
  double step_phase = 0.0;
  double cadence_hz = 0.0;   ///< 0 while standing.
  double bounce_mps2 = 0.0;  ///< Peak to peak of the vertical acceleration. [Weinberg2002]
  bool is_first_step = false;
  bool is_last_step = false;
  bool is_in_place = false;  ///< Steps without leading on.
};

/// A walk laid out in time: spells of standing (and turning on the spot) and steps, some of them in
/// place.
class Walk {
 public:
  Walk(const Building& building, std::vector<Stroke> strokes, const Person& person,
       const GaitOptions& options, core::Rng& rng);

  double duration_s() const { return spells_.back().end_s; }
  /// From 0 to duration_s.
  BodyState at(double t_s) const;

  struct Step {
    double end_s = 0.0;
    double length_m = 0.0;
    bool is_effective = true;
  };
  std::vector<Step> steps() const;
  /// When named places are passed, rising.
  const std::vector<double>& tap_times_s() const { return tap_times_s_; }
  double path_length_m() const;

 private:
  struct Spell {
    double start_s = 0.0;
    double end_s = 0.0;
    std::size_t stroke = 0;
    double start_arc_m = 0.0;
    double end_arc_m = 0.0;
    double start_heading_rad = 0.0;  ///< Standing: turns from here
    double end_heading_rad = 0.0;    ///< to here. Walking: both are the turns to add to the path's.
    double step_index = 0.0;
    bool is_step = false;
    bool is_first = false;
    bool is_last = false;
    double bounce_mps2 = 0.0;
    bool is_effective = true;
    double turn_rad = 0.0;      ///< In place: the body turns so far and back,
    double turn_start_s = 0.0;  ///< from then
    double turn_end_s = 0.0;    ///< to then.
  };
  /// Stepping in place on the way.
  struct Episode {
    double walked_m = 0.0;  ///< Where: length of the way before it.
    int steps = 0;
    double turn_rad = 0.0;
    double bounce_mps2 = 0.0;
  };

  void draw_episodes(const GaitOptions& options, core::Rng& rng);
  /// The episodes that are due before the step that starts at `arc_m`.
  void add_due_episodes(std::size_t stroke, double arc_m, double turns_rad);
  void stand(std::size_t stroke, double arc_m, double duration_s, double to_heading_rad);
  void add_steps(std::size_t stroke, const Person& person, const GaitOptions& options,
                 core::Rng& rng);
  void add_taps(std::size_t stroke, std::size_t first_spell);
  double elevation_m(std::size_t stroke, double arc_m) const;

  const Building& building_;
  std::vector<Stroke> strokes_;
  std::vector<Spell> spells_;
  std::vector<double> tap_times_s_;
  std::vector<Episode> episodes_;  ///< By rising walked_m.
  std::size_t episodes_done_ = 0;
  double strokes_done_m_ = 0.0;  ///< Length of the strokes before the present one.
  double heading_rad_ = 0.0;
  double step_count_ = 0.0;
};

}  // namespace waylode::sim::detail
