// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
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

/// A switch, as the words "off" and "on".
Choice switch_of(bool& target) {
  static constexpr std::array<std::string_view, 2> kWords = {"off", "on"};
  return {kWords, [&target] { return target ? std::size_t{1} : std::size_t{0}; },
          [&target](std::size_t index) { target = index == 1; }};
}

Choice compared_choice(radio::Compared& compared) {
  static constexpr std::array<std::string_view, 3> kNames = {"union", "query", "common_mean"};
  return choice_of(compared, kNames);
}

constexpr std::string_view kComparedHelp =
    "Transmitters that a distance runs over: of either, of the scan, or the mean over both's.";

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

/// What all ways of nearest neighbours have.
template <typename Nearest>
void visit_nearest(const Table& table, Nearest& options, const char* neighbours) {
  table.number("neighbours", options.neighbours, 1, 1000, neighbours)
      .choice("compared", compared_choice(options.compared), kComparedHelp)
      .number("base_sigma_m", options.base_sigma_m, kAboveZero, kHuge,
              "Error of a place per axis where all neighbours agree.")
      .number("spread_gain", options.spread_gain, 0.0, kHuge,
              "Share of the neighbours' scatter that adds to the error's covariance.");
}

void visit_windows(radio::WindowKnn::Options& window, const Table& table) {
  constexpr std::size_t kShown = 4;
  static constexpr std::array<std::array<std::string_view, 3>, kShown> kNames = {
      {{"from_1_dbm", "below_1_db", "above_1_db"},
       {"from_2_dbm", "below_2_db", "above_2_db"},
       {"from_3_dbm", "below_3_db", "above_3_db"},
       {"from_4_dbm", "below_4_db", "above_4_db"}}};
  for (std::size_t i = 0; i < std::min(kShown, window.windows.size()); ++i) {
    radio::WindowKnn::Window& row = window.windows[i];
    table
        .number(kNames[i][0], row.from_dbm, -127.5, 0.0,
                "Levels from here up have this window; rows by falling level.")
        .number(kNames[i][1], row.below_db, kAboveZero, 100.0,
                "How much weaker a point may be and still be accepted.")
        .number(kNames[i][2], row.above_db, kAboveZero, 100.0, "And how much stronger.");
  }
}

void visit_neighbours(Options& options, const Visit& visit) {
  static constexpr std::array<std::string_view, 2> kKeep = {"most_hits", "all_hits"};
  const Table knn("knn", visit);
  visit_nearest(knn, options.knn, "Nearest reference points averaged.");
  knn.choice("weighted", switch_of(options.knn.weighted), "By inverse distance; else all alike.");
  visit_nearest(Table("region", visit), options.region,
                "Nearest points of the strongest transmitter's region, averaged.");
  const Table window("window", visit);
  visit_nearest(window, options.window, "Nearest of the kept points, averaged.");
  window
      .number("strongest", options.window.strongest, 1, 1000,
              "Transmitters of the scan that accept points, the strongest.")
      .choice("keep", choice_of(options.window.keep, kKeep),
              "Points with the most acceptances, or those that all accept.")
      .number("slack_hits", options.window.slack_hits, 0, 1000,
              "Points are kept with this many fewer acceptances than the best.");
  visit_windows(options.window, window);
  const Table circle("circle", visit);
  visit_nearest(circle, options.circle, "Nearest points of the circle, averaged.");
  circle
      .number("radius_m", options.circle.radius_m, kAboveZero, 1000.0,
              "Points this near to where the steps led are compared.")
      .number("reading_sigma_db", options.circle.reading_sigma_db, kAboveZero, 100.0,
              "How far readings err, for how well the circle fits.")
      .number("independent_readings", options.circle.independent_readings, kAboveZero, kHuge,
              "No more readings of a scan count, since they err together.");
}

void visit_kernel(learn::Kernel::Options& kernel, const Visit& visit) {
  static constexpr std::array<std::string_view, 2> kCombinations = {"sum", "product"};
  Table("regression.kernel", visit)
      .choice("combination", choice_of(kernel.combination, kCombinations),
              "How the three kernels make one.")
      .number("spline_weight", kernel.spline_weight, 0.0, kHuge, "Of the spline kernel.")
      .number("gauss_weight", kernel.gauss_weight, 0.0, kHuge, "Of the Gauss kernel.")
      .number("laplace_weight", kernel.laplace_weight, 0.0, kHuge, "Of the Laplace kernel.")
      .number("gauss_rate", kernel.gauss_rate, kAboveZero, kHuge,
              "Per squared distance of inputs scaled to one.")
      .number("laplace_rate", kernel.laplace_rate, kAboveZero, kHuge, "The same.")
      .choice("normalise_spline", switch_of(kernel.normalise_spline),
              "Needed from some five transmitters on, where the spline drowns the others.");
}

void visit_relevance(learn::RelevanceVectorRegression::Options& relevance, const Visit& visit) {
  learn::SparseBayesFit::Options& fit = relevance.fit;
  Table("regression.relevance", visit)
      .number("max_iterations", fit.max_iterations, 1, 1000000, "Of the training.")
      .number("tolerance", fit.tolerance, kAboveZero, 1.0,
              "Training ends when no logarithm of a precision moves by more.")
      .number("prune_above", fit.prune_above, 1.000001, 1e12,
              "Vectors whose weight's precision exceeds this are left out.")
      .number("start_precision", fit.start_precision, 1e-9, 1e3, "All precisions at the start.")
      .number("start_noise_ratio", fit.start_noise_ratio, kAboveZero, 10.0,
              "Noise variance at the start, as a share of the targets' mean square.")
      .number("min_noise_sigma", fit.min_noise_sigma, 1e-9, 1e9,
              "Metres of noise that are believed at the least.")
      .choice("bias", switch_of(relevance.bias), "A constant with a precision of its own.")
      .choice("centre_targets", switch_of(relevance.centre_targets),
              "Take the targets' mean off first.");
}

void visit_regression(Options& options, const Visit& visit) {
  radio::RegressionPositioner::Options& regression = options.regression;
  Table("regression", visit)
      .number("max_transmitters", regression.max_transmitters, 1, 1000,
              "Per floor, those that vary the most.")
      .number("rate_transmitters", regression.rate_transmitters, kAboveZero, kHuge,
              "The kernels' rates are for so many transmitters; with more they shrink.")
      .number("max_points", regression.max_points, 5, 2000,
              "Per floor; training takes the cube of it.")
      .number("floor_neighbours", regression.floor_neighbours, 1, 1000,
              "Nearest points that vote for the floor.")
      .number("scan_sigma_db", regression.scan_sigma_db, 0.0, 100.0,
              "Noise of a scan's readings; its effect on the place adds to the error.")
      .number("unknown_sigma_m", regression.unknown_sigma_m, kAboveZero, kHuge,
              "Error per axis where the regressor knows none.")
      .number("min_sigma_m", regression.min_sigma_m, kAboveZero, kHuge,
              "No regressor is believed to be better.")
      .number("margin_m", regression.margin_m, 0.0, kHuge,
              "How far outside the surveyed box a place may lie.")
      .number("support_cost", regression.support.cost, kAboveZero, 1e6,
              "Support vectors: what a unit of error beyond epsilon costs.")
      .number("support_epsilon", regression.support.epsilon, 0.0, kHuge,
              "Support vectors: errors below cost nothing.")
      .number("support_tolerance", regression.support.tolerance, 1e-9, 1.0,
              "Support vectors: how well the conditions of the optimum must hold.");
  visit_kernel(regression.relevance.kernel, visit);
  visit_relevance(regression.relevance, visit);
  Table("regression.scaler", visit)
      .number("clip_low", regression.scaler.clip_low, -10.0, 0.0,
              "Inputs are cut off below; 0 is the weakest surveyed.")
      .number("clip_high", regression.scaler.clip_high, 1.0, 10.0,
              "And above; 1 is the strongest surveyed.");
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
      .number("largest_turn_rad", sequence.largest_turn_rad, 0.0, core::kPi,
              "The path is tried turned by up to this; 0 takes it as it is.")
      .number("turn_step_rad", sequence.turn_step_rad, kAboveZero, core::kPi,
              "Between the turns that are tried.")
      .number("correlation_m", sequence.correlation_m, kAboveZero, kHuge,
              "Differences closer together on the path are one.")
      .number("map_sigma_m", sequence.map_sigma_m, 0.0, kHuge, "Of the map's own places.")
      .number("widest_sigma_m", sequence.widest_sigma_m, kAboveZero, kHuge,
              "A direction less certain than this is not known at all.")
      .number("bias_sigma_ut", sequence.bias_sigma_ut, 0.0, kHuge,
              "The phone's own constant part of the field; 0 trusts the phone.")
      .number("field_sigma_ut", sequence.field_sigma_ut, kAboveZero, kHuge,
              "Of map against phone, without the constant part.");
}

void visit_guesses(magnetic::FieldLikelihood::Options& guesses, const Visit& visit) {
  Table("field.guesses", visit)
      .number("node_m", guesses.node_m, 0.05, 20.0, "Between the nodes of the field's raster.")
      .number("kernel_m", guesses.kernel_m, kAboveZero, 100.0, "Sigma of the survey's kernel.")
      .number("reach_m", guesses.reach_m, 0.05, 100.0, "Survey farther off says nothing.")
      .number("trust_points", guesses.trust_points, kAboveZero, kHuge,
              "So much kernel weight is half known ground.")
      .number("field_sigma_ut", guesses.field_sigma_ut, kAboveZero, 1000.0,
              "Of reading against map at one place, per part.")
      .number("bias_sigma_ut", guesses.bias_sigma_ut, 0.0, 1000.0,
              "The phone's own constant part; 0 trusts the phone.")
      .number("cap_sigmas", guesses.cap_sigmas, kAboveZero, 100.0,
              "A reading farther off counts as this far off.")
      .number("correlation_m", guesses.correlation_m, kAboveZero, 100.0,
              "Readings within this much of walking are one.")
      .number("weight_ratio", guesses.weight_ratio, kAboveZero, 1.0,
              "Power on a whole reading's likelihood; less where the map is old.");
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
              "Chi-square beyond which a place is far off.")
      .number("lost_heading_sigma_rad", filter.lost_heading_sigma_rad, kAboveZero, kHuge,
              "Doubt of the heading after that.")
      .number("spread_alpha", filter.spread.alpha, kAboveZero, 1.0,
              "How far the sigma points lie from the mean.")
      .number("spread_beta", filter.spread.beta, 0.0, kHuge, "2 suits a Gaussian.")
      .number("spread_kappa", filter.spread.kappa, -5.0, kHuge, "The second spread parameter.");
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
  Table("interval.velocity_filter", visit)
      .number("acceleration_variance_m2ps4", interval.velocity_filter.acceleration_variance_m2ps4,
              kAboveZero, kHuge, "How fast the walker changes speed, per axis.")
      .number("start_speed_sigma_mps", interval.velocity_filter.start_speed_sigma_mps, kAboveZero,
              kHuge, "Per axis, before anything is measured.");
  Table("interval.blend", visit)
      .number("speed_last_ratio", interval.blend.speed.last, 0.0, 1.0,
              "Share of the last speed; the three sum to one.")
      .number("speed_fused_ratio", interval.blend.speed.fused, 0.0, 1.0, "Of the fused speed.")
      .number("speed_sensed_ratio", interval.blend.speed.sensed, 0.0, 1.0, "Of the sensed speed.")
      .number("heading_last_ratio", interval.blend.heading.last, 0.0, 1.0,
              "Share of the last heading; the three sum to one.")
      .number("heading_fused_ratio", interval.blend.heading.fused, 0.0, 1.0,
              "Of the fused heading.")
      .number("heading_sensed_ratio", interval.blend.heading.sensed, 0.0, 1.0,
              "Of the sensed heading.")
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
      .choice("use_whole_map", switch_of(feedback.use_whole_map),
              "Whole-map places are measurements too, for reading = \"filtered\".")
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
  visit_regression(options, visit);
  visit_field(options, visit);
  visit_guesses(options.field.guesses, visit);
  visit_decision(options, visit);
  visit_interval(options, visit);
  visit_feedback(options, visit);
}

}  // namespace waylode::pipeline::detail
