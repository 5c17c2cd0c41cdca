// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/sim/detail/walk.hpp"

#include <algorithm>
#include <cmath>

#include "waylode/core/angle.hpp"

namespace waylode::sim::detail {

namespace {

constexpr double kStairsCadence_hz = 1.6;
constexpr double kLowestCadence_hz = 1.2;
constexpr double kHighestCadence_hz = 2.6;
constexpr double kInPlaceCadence_hz = 1.5;

/// Peak-to-peak vertical acceleration of a step, after [Weinberg2002] turned round.
double bounce_mps2(const Person& person, double length_m) {
  return std::pow(length_m / person.bounce_constant, 4.0);
}

/// The cadence at which this person is that fast on the flat; speed rises with cadence.
double cadence_for_speed(const Person& person, double speed_mps) {
  double low = kLowestCadence_hz;
  double high = kHighestCadence_hz;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (step_length_m(person, middle) * middle < speed_mps ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

Person draw_person(const GaitOptions& options, core::Rng& rng) {
  Person person;
  person.height_m = options.height_m;
  const double drawn_scale = std::clamp(rng.normal(1.0, 0.06), 0.82, 1.18);
  const double drawn_bounce = std::clamp(rng.normal(0.42, 0.025), 0.345, 0.495);
  const double drawn_cadence_hz = rng.uniform(1.7, 2.0);
  person.step_scale_ratio = options.step_scale_ratio.value_or(drawn_scale);
  person.bounce_constant = options.bounce_constant.value_or(drawn_bounce);
  person.cadence_hz = options.speed_mps ? cadence_for_speed(person, *options.speed_mps)
                                        : options.cadence_hz.value_or(drawn_cadence_hz);
  return person;
}

double step_length_m(const Person& person, double cadence_hz) {
  const double h = person.height_m;
  const double length_m = 0.7 + 0.371 * (h - 1.75) + 0.227 * (cadence_hz - 1.79) * h / 1.75;
  return person.step_scale_ratio * length_m;
}

Walk::Walk(const Building& building, std::vector<Stroke> strokes, const Person& person,
           const GaitOptions& options, core::Rng& rng)
    : building_(building), strokes_(std::move(strokes)) {
  heading_rad_ = strokes_.front().path.heading_rad(0.0);
  stand(0, 0.0, options.stand_before_s, heading_rad_);
  draw_episodes(options, rng);
  for (std::size_t i = 0; i < strokes_.size(); ++i) {
    const double turn_rad = core::wrap_angle(strokes_[i].path.heading_rad(0.0) - heading_rad_);
    constexpr double kTurnRate_radps = 2.5;
    const double turn_s =
        std::abs(turn_rad) > 0.05 ? 0.3 + std::abs(turn_rad) / kTurnRate_radps : 0.0;
    if (strokes_[i].pause_before_s > 0.0) stand(i, 0.0, strokes_[i].pause_before_s, heading_rad_);
    stand(i, 0.0, turn_s, heading_rad_ + turn_rad);
    const std::size_t first_spell = spells_.size();
    add_steps(i, person, options, rng);
    add_taps(i, first_spell);
    strokes_done_m_ += strokes_[i].path.length_m();
  }
  stand(strokes_.size() - 1, strokes_.back().path.length_m(), options.stand_before_s, heading_rad_);
}

void Walk::draw_episodes(const GaitOptions& options, core::Rng& rng) {
  const auto photo_stops = static_cast<int>(std::round(options.photo_stops));
  const auto dodges = static_cast<int>(std::round(options.dodges));
  const double whole_m = path_length_m();
  constexpr double kUndisturbed_m = 5.0;
  const double margin_m = std::min(kUndisturbed_m, 0.25 * whole_m);
  for (int i = 0; i < photo_stops + dodges; ++i) {
    const bool is_photo = i < photo_stops;
    const double duration_s = is_photo ? rng.uniform(3.0, 6.0) : rng.uniform(1.0, 2.0);
    const double turn_deg = is_photo ? rng.uniform(50.0, 110.0) : rng.uniform(25.0, 60.0);
    Episode episode;
    episode.walked_m = rng.uniform(margin_m, whole_m - margin_m);
    episode.steps = static_cast<int>(std::round(duration_s * kInPlaceCadence_hz));
    episode.turn_rad = core::radians_from_degrees(rng.below(2) == 0 ? turn_deg : -turn_deg);
    episode.bounce_mps2 = rng.uniform(2.5, 5.5);
    episodes_.push_back(episode);
  }
  std::stable_sort(episodes_.begin(), episodes_.end(),
                   [](const Episode& a, const Episode& b) { return a.walked_m < b.walked_m; });
}

void Walk::add_due_episodes(std::size_t stroke, double arc_m, double turns_rad) {
  if (strokes_[stroke].is_stairs()) return;
  for (; episodes_done_ < episodes_.size(); ++episodes_done_) {
    const Episode& episode = episodes_[episodes_done_];
    if (episode.walked_m > strokes_done_m_ + arc_m) return;
    Spell spell;
    spell.stroke = stroke;
    spell.start_arc_m = spell.end_arc_m = arc_m;
    spell.start_heading_rad = spell.end_heading_rad = turns_rad;
    spell.is_step = true;
    spell.is_effective = false;
    spell.bounce_mps2 = episode.bounce_mps2;
    spell.turn_rad = episode.turn_rad;
    spell.turn_start_s = spells_.back().end_s;
    spell.turn_end_s = spell.turn_start_s + episode.steps / kInPlaceCadence_hz;
    for (int i = 0; i < episode.steps; ++i) {
      spell.start_s = spells_.back().end_s;
      spell.end_s = spell.turn_start_s + (i + 1) / kInPlaceCadence_hz;
      spell.step_index = step_count_;
      spells_.push_back(spell);
      step_count_ += 1.0;
    }
  }
}

void Walk::stand(std::size_t stroke, double arc_m, double duration_s, double to_heading_rad) {
  Spell spell;
  spell.start_s = spells_.empty() ? 0.0 : spells_.back().end_s;
  spell.end_s = spell.start_s + duration_s;
  spell.stroke = stroke;
  spell.start_arc_m = spell.end_arc_m = arc_m;
  spell.start_heading_rad = heading_rad_;
  spell.end_heading_rad = to_heading_rad;
  spell.step_index = step_count_;
  heading_rad_ = to_heading_rad;
  if (duration_s > 0.0 || spells_.empty()) spells_.push_back(spell);
}

void Walk::add_steps(std::size_t stroke, const Person& person, const GaitOptions& options,
                     core::Rng& rng) {
  const Path& path = strokes_[stroke].path;
  const bool is_stairs = strokes_[stroke].is_stairs();
  constexpr double kStairsStep_m = 0.28;
  const double cadence_hz = is_stairs ? kStairsCadence_hz : person.cadence_hz;
  const double mean_m = is_stairs ? kStairsStep_m : step_length_m(person, cadence_hz);
  const auto count = static_cast<std::size_t>(std::max(1.0, std::round(path.length_m() / mean_m)));
  std::vector<double> cadences_hz;
  std::vector<double> lengths_m;
  double sum_m = 0.0;
  double tempo = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    constexpr double kTempoMemory = 0.8;
    tempo = kTempoMemory * tempo + std::sqrt(1.0 - kTempoMemory * kTempoMemory) * rng.normal();
    cadences_hz.push_back(cadence_hz * (1.0 + options.cadence_sigma_ratio * tempo));
    double length_m = is_stairs ? kStairsStep_m : step_length_m(person, cadences_hz.back());
    length_m *= std::max(0.3, 1.0 + options.step_sigma_ratio * rng.normal());
    // People start and stop with a shorter step.
    if (!is_stairs && count > 2 && (i == 0 || i + 1 == count)) length_m *= options.end_step_ratio;
    lengths_m.push_back(length_m);
    sum_m += length_m;
  }
  const double turns_rad = heading_rad_ - path.heading_rad(0.0);
  double arc_m = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    add_due_episodes(stroke, arc_m, turns_rad);
    Spell spell;
    spell.start_s = spells_.back().end_s;
    spell.end_s = spell.start_s + 1.0 / cadences_hz[i];
    spell.stroke = stroke;
    spell.start_arc_m = arc_m;
    arc_m = i + 1 == count ? path.length_m() : arc_m + lengths_m[i] * path.length_m() / sum_m;
    spell.end_arc_m = arc_m;
    spell.start_heading_rad = spell.end_heading_rad = turns_rad;
    spell.step_index = step_count_;
    spell.is_step = true;
    spell.is_first = i == 0;
    spell.is_last = i + 1 == count;
    // Stairs shake about as much as a level walk at their cadence.
    const double swing_m =
        is_stairs ? step_length_m(person, kStairsCadence_hz) : spell.end_arc_m - spell.start_arc_m;
    spell.bounce_mps2 = bounce_mps2(person, swing_m);
    if (options.bounce_sigma_ratio > 0.0) {
      spell.bounce_mps2 *= std::exp(options.bounce_sigma_ratio * rng.normal());
    }
    spells_.push_back(spell);
    step_count_ += 1.0;
  }
  heading_rad_ = turns_rad + path.heading_rad(path.length_m());
}

void Walk::add_taps(std::size_t stroke, std::size_t first_spell) {
  for (const double tap_arc_m : strokes_[stroke].taps_arc_m) {
    for (std::size_t i = first_spell; i < spells_.size(); ++i) {
      const Spell& spell = spells_[i];
      if (!spell.is_effective || tap_arc_m > spell.end_arc_m) continue;
      const double ratio = (tap_arc_m - spell.start_arc_m) / (spell.end_arc_m - spell.start_arc_m);
      tap_times_s_.push_back(spell.start_s + std::max(0.0, ratio) * (spell.end_s - spell.start_s));
      break;
    }
  }
}

double Walk::elevation_m(std::size_t stroke, double arc_m) const {
  const Stroke& walked = strokes_[stroke];
  const double from_m = building_.floor(walked.floor).elevation_m;
  const double to_m = building_.floor(walked.end_floor).elevation_m;
  return from_m + (to_m - from_m) * arc_m / walked.path.length_m();
}

BodyState Walk::at(double t_s) const {
  const auto above =
      std::upper_bound(spells_.begin() + 1, spells_.end(), t_s,
                       [](double value, const Spell& spell) { return value < spell.start_s; });
  const Spell& spell = *(above - 1);
  const double duration_s = spell.end_s - spell.start_s;
  const double ratio =
      duration_s > 0.0 ? std::clamp((t_s - spell.start_s) / duration_s, 0.0, 1.0) : 0.0;
  const Stroke& stroke = strokes_[spell.stroke];
  const double arc_m = spell.start_arc_m + ratio * (spell.end_arc_m - spell.start_arc_m);
  BodyState state;
  state.position_m = stroke.path.position_m(arc_m);
  state.floor = 2.0 * arc_m > stroke.path.length_m() ? stroke.end_floor : stroke.floor;
  state.elevation_m = elevation_m(spell.stroke, arc_m);
  state.step_phase = spell.step_index;
  if (!spell.is_step) {
    const double eased = ratio * ratio * (3.0 - 2.0 * ratio);
    state.heading_rad =
        spell.start_heading_rad + eased * (spell.end_heading_rad - spell.start_heading_rad);
    return state;
  }
  state.heading_rad = spell.start_heading_rad + stroke.path.heading_rad(arc_m);
  if (!spell.is_effective) {
    state.is_in_place = true;
    const double swung =
        std::sin(core::kPi * (t_s - spell.turn_start_s) / (spell.turn_end_s - spell.turn_start_s));
    state.heading_rad += spell.turn_rad * swung * swung;
  }
  state.speed_mps = (spell.end_arc_m - spell.start_arc_m) / duration_s;
  state.step_phase = spell.step_index + ratio;
  state.cadence_hz = 1.0 / duration_s;
  state.bounce_mps2 = spell.bounce_mps2;
  state.is_first_step = spell.is_first;
  state.is_last_step = spell.is_last;
  return state;
}

std::vector<Walk::Step> Walk::steps() const {
  std::vector<Step> steps;
  for (const Spell& spell : spells_) {
    if (!spell.is_step) continue;
    steps.push_back({spell.end_s, spell.end_arc_m - spell.start_arc_m, spell.is_effective});
  }
  return steps;
}

double Walk::path_length_m() const {
  double sum_m = 0.0;
  for (const Stroke& stroke : strokes_) sum_m += stroke.path.length_m();
  return sum_m;
}

}  // namespace waylode::sim::detail
