// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <limits>

#include "waylode/core/angle.hpp"
#include "waylode/pipeline/detail/option_table.hpp"

namespace waylode::pipeline::detail {
namespace {

/// A choice between the values of an enumeration that starts at 0, named in its order.
template <typename Enum, std::size_t count>
Choice choice_of(Enum& target, const std::array<std::string_view, count>& names) {
  return {names, [&target] { return static_cast<std::size_t>(target); },
          [&target](std::size_t index) { target = static_cast<Enum>(index); }};
}

void visit_references(Options& options, const Visit& visit) {
  static constexpr std::array<std::string_view, 4> kModes = {"off", "half_range", "mad", "literal"};
  Table("references", visit)
      .number("merge_radius_m", options.references.merge_radius_m, 0.0, 100.0,
              "Surveyed scans this near become one reference point; 1 or 2 for a walked survey.")
      .number("fill_dbm", options.references.fill_dbm, -127.5, -50.0,
              "Stands for a transmitter that is not heard.")
      .number("min_heard_ratio", options.references.min_heard_ratio, 0.0, 1.0,
              "Transmitters that fewer of a point's scans heard are left out of it.")
      .choice("filter", choice_of(options.references.filter.mode, kModes),
              "Which readings of a point count as wild and are replaced.")
      .number("mad_factor", options.references.filter.mad_factor, kAboveZero, kHuge,
              "Of 1.4826 MAD, how far a reading may lie from the median.")
      .number("min_mad_db", options.references.filter.min_mad_db, 0.0, kHuge,
              "No smaller MAD is believed, since phones tell whole decibels.");
}

void visit_neighbours(Options& options, const Visit& visit) {
  Table("knn", visit)
      .number("neighbours", options.knn.neighbours, 1, 1000, "Nearest reference points averaged.")
      .number("base_sigma_m", options.knn.base_sigma_m, kAboveZero, kHuge,
              "Error of a place per axis where all neighbours agree.")
      .number("spread_gain", options.knn.spread_gain, 0.0, kHuge,
              "Share of the neighbours' scatter that adds to the error's covariance.");
  Table("region", visit)
      .number("neighbours", options.region.neighbours, 1, 1000,
              "Nearest points of the strongest transmitter's region, averaged.")
      .number("base_sigma_m", options.region.base_sigma_m, kAboveZero, kHuge, "As in [knn].")
      .number("spread_gain", options.region.spread_gain, 0.0, kHuge, "As in [knn].");
  Table("window", visit)
      .number("strongest", options.window.strongest, 1, 1000,
              "Transmitters of the scan that accept points, the strongest.")
      .number("slack_hits", options.window.slack_hits, 0, 1000,
              "Points are kept with this many fewer acceptances than the best.")
      .number("neighbours", options.window.neighbours, 1, 1000, "Nearest of the kept, averaged.")
      .number("base_sigma_m", options.window.base_sigma_m, kAboveZero, kHuge, "As in [knn].")
      .number("spread_gain", options.window.spread_gain, 0.0, kHuge, "As in [knn].");
  Table("circle", visit)
      .number("radius_m", options.circle.radius_m, kAboveZero, 1000.0,
              "Points this near to where the steps led are compared.")
      .number("neighbours", options.circle.neighbours, 1, 1000, "Nearest of them, averaged.")
      .number("base_sigma_m", options.circle.base_sigma_m, kAboveZero, kHuge, "As in [knn].")
      .number("spread_gain", options.circle.spread_gain, 0.0, kHuge, "As in [knn].");
}

void visit_field(Options& options, const Visit& visit) {
  Table("field", visit)
      .number("interval_s", options.field.interval_s, 0.0, kHuge, "Between two magnetic matches.");
  Table("field.grid", visit)
      .number("node_m", options.field.grid.node_m, 0.05, 100.0, "Between the raster's nodes.")
      .number("reach_m", options.field.grid.reach_m, kAboveZero, 100.0,
              "Farther from surveyed ground nothing is known.")
      .number("kernel_m", options.field.grid.kernel_m, kAboveZero, 100.0,
              "How far a surveyed point counts; wider is smoother.");
  magnetic::SequenceMatcher::Options& sequence = options.field.sequence;
  Table("field.sequence", visit)
      .number("window_s", sequence.window_s, kAboveZero, 600.0, "Walking matched at once.")
      .number("spacing_m", sequence.spacing_m, kAboveZero, 100.0,
              "Readings are averaged over this much of the path.")
      .number("shortest_path_m", sequence.shortest_path_m, kAboveZero, kHuge,
              "A window walked less than this is not matched.")
      .number("least_known_ratio", sequence.least_known_ratio, kAboveZero, 1.0,
              "Share of the window that must lie on the map.")
      .number("step_m", sequence.step_m, kAboveZero, 100.0, "Between the shifts that are tried.")
      .number("search_sigmas", sequence.search_sigmas, kAboveZero, 100.0,
              "How far around the place expected is searched, in its sigmas.")
      .number("narrowest_search_m", sequence.narrowest_search_m, kAboveZero, kHuge,
              "No less than this.")
      .number("widest_search_m", sequence.widest_search_m, kAboveZero, kHuge,
              "And no more; cost goes with its square.")
      .number("bias_sigma_ut", sequence.bias_sigma_ut, 0.0, kHuge,
              "The phone's own constant part of the field; 0 trusts the phone.")
      .number("field_sigma_ut", sequence.field_sigma_ut, kAboveZero, kHuge,
              "Of map against phone, without the constant part.");
}

void visit_filter(std::string_view name, fusion::StepPositionFilter::Options& filter,
                  const Visit& visit) {
  Table(name, visit)
      .number("heading_offset_sigma_rad", filter.heading_offset_sigma_rad, 0.0, kHuge,
              "How far walking and phone headings may differ at the start.")
      .number("log_scale_sigma", filter.log_scale_sigma, 0.0, kHuge,
              "Spread of people's step lengths, as a logarithm.")
      .number("heading_offset_walk_rad_per_sqrt_step", filter.heading_offset_walk_rad_per_sqrt_step,
              0.0, kHuge, "How fast the heading offset changes.")
      .number("log_scale_walk_per_sqrt_step", filter.log_scale_walk_per_sqrt_step, 0.0, kHuge,
              "How fast a person's step length changes.")
      .number("position_walk_m_per_sqrt_s", filter.position_walk_m_per_sqrt_s, kAboveZero, kHuge,
              "Movement that no step tells.")
      .number("radio_bias_sigma_m", filter.radio_bias_sigma_m, 0.0, kHuge,
              "The part of the radio error that persists from scan to scan.")
      .number("radio_bias_tau_s", filter.radio_bias_tau_s, kAboveZero, kHuge,
              "How long a radio error persists.")
      .number("radio_sigma_scale", filter.radio_sigma_scale, kAboveZero, kHuge,
              "Multiplies the error that a place states for itself.")
      .number("radio_floor_sigma_m", filter.radio_floor_sigma_m, 0.0, kHuge,
              "What that error does not know of.")
      .number("gate", filter.gate, kAboveZero, kHuge,
              "Chi-square beyond which a place is believed less.")
      .number("lost_failures", filter.lost_failures, 0, 100,
              "This many far-off places among the newest begin the filter anew; 0 never.")
      .number("lost_window", filter.lost_window, 1, 100, "The newest places that are counted.")
      .number("lost_gate", filter.lost_gate, kAboveZero, kHuge,
              "Chi-square beyond which a place is far off.");
}

void visit_decision(Options& options, const Visit& visit) {
  Table("decision", visit)
      .number("threshold_m", options.decision.threshold_m, 0.0, kHuge,
              "A larger difference of steps and scan is corrected.")
      .number("pairs", options.decision.pairs, 1, 1000,
              "Compared pairs that a correction averages.")
      .number("literal_gain_ratio", options.decision.literal_gain_ratio, 0.0, 1.0,
              "Where between steps and scan the corrected place lies.");
  visit_filter("decision.filter", options.decision.filter, visit);
}

void visit_interval(Options& options, const Visit& visit) {
  static constexpr std::array<std::string_view, 3> kModes = {
      "inverse_variance", "intervals_more_wifi", "intervals_magnetic"};
  fusion::ZhouTracker::Options& interval = options.interval;
  Table("interval", visit)
      .number("start_scans", interval.start_scans, 1, 1000, "Scans that the start averages.")
      .number("start_within_s", interval.start_within_s, 0.0, kHuge, "From the first of them.")
      .number("correction_ratio", interval.correction_ratio, kAboveZero, 1.0,
              "Way towards the weighted point that each correction goes.")
      .number("fused_velocity_s", interval.fused_velocity_s, kAboveZero, kHuge,
              "Span of weighted points that a velocity is taken over.")
      .number("magnetic_sigma_scale", interval.magnetic_sigma_scale, kAboveZero, kHuge,
              "Multiplies the error that a magnetic place states; matches share their windows.")
      .number("magnetic_floor_sigma_m", interval.magnetic_floor_sigma_m, 0.0, kHuge,
              "What that error does not know of.")
      .number("magnetic_gate", interval.magnetic_gate, kAboveZero, kHuge,
              "Chi-square beyond which a magnetic place is left.");
  Table("interval.weighting", visit)
      .choice("mode", choice_of(interval.weighting.mode, kModes),
              "How Wi-Fi and magnetic places are weighted.")
      .number("first_interval_s", interval.weighting.first_interval_s, 0.0, kHuge,
              "Before it Wi-Fi alone; for weights by interval.")
      .number("second_interval_s", interval.weighting.second_interval_s, 0.0, kHuge,
              "After it the late share; not less than the first.")
      .number("magnetic_share_ratio", interval.weighting.magnetic_share_ratio, 0.0, 1.0,
              "Share of the magnetic place between the two.")
      .number("magnetic_share_late_ratio", interval.weighting.magnetic_share_late_ratio, 0.0, 1.0,
              "Its share afterwards.");
  Table("interval.blend", visit)
      .number("turn_rad", interval.blend.turn_rad, kAboveZero, core::kPi,
              "Sensed heading this far from the last one is a turn.")
      .number("fastest_mps", interval.blend.fastest_mps, kAboveZero, kHuge,
              "The fused speed counts no more than this.")
      .number("slowest_mps", interval.blend.slowest_mps, 0.0, kHuge,
              "A slower one has no direction.");
  visit_filter("interval.filter", interval.filter, visit);
}

void visit_feedback(Options& options, const Visit& visit) {
  static constexpr std::array<std::string_view, 4> kReadings = {"closed_loop", "open_loop",
                                                                "blended", "filtered"};
  fusion::FeedbackTracker::Options& feedback = options.feedback;
  Table("feedback", visit)
      .choice("reading", choice_of(feedback.reading, kReadings),
              "What the place found near the steps does to them.")
      .number("blend_ratio", feedback.blend_ratio, 0.0, 1.0,
              "Share of the radio place, for reading = \"blended\".")
      .number("guard_gate", feedback.guard_gate, kAboveZero,
              std::numeric_limits<double>::infinity(),
              "Chi-square beyond which a whole-map place disagrees.")
      .number("guard_failures", feedback.guard_failures, 1, 100,
              "This many disagreements among the newest begin anew.")
      .number("guard_window", feedback.guard_window, 1, 100, "The newest places that are counted.")
      .number("circle_sigma_scale", feedback.circle_sigma_scale, kAboveZero, kHuge,
              "Multiplies the error that a place near the steps states.")
      .number("circle_floor_sigma_m", feedback.circle_floor_sigma_m, 0.0, kHuge,
              "What that error does not know of.")
      .number("hypotheses", feedback.hypotheses, 1, 16, "Starts followed side by side.")
      .number("whole_map_score", feedback.whole_map_score, 0.0, kHuge,
              "Power of the whole-map places' likelihood.")
      .number("circle_score", feedback.circle_score, 0.0, kHuge,
              "Power of the likelihood of what was found near the steps.")
      .number("score_kept_ratio", feedback.score_kept_ratio, 0.0, 1.0,
              "Of a hypothesis' score, from scan to scan.")
      .number("merge_within_m", feedback.merge_within_m, 0.0, kHuge,
              "Hypotheses this near are one.");
  visit_filter("feedback.filter", feedback.filter, visit);
}

}  // namespace

void visit_paper_options(Options& options, const Visit& visit) {
  visit_references(options, visit);
  visit_neighbours(options, visit);
  visit_field(options, visit);
  visit_decision(options, visit);
  visit_interval(options, visit);
  visit_feedback(options, visit);
}

}  // namespace waylode::pipeline::detail
