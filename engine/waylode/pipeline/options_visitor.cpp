// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pipeline/options_visitor.hpp"

#include <array>

#include "waylode/pipeline/detail/option_table.hpp"

namespace waylode::pipeline {
namespace {

using detail::kHuge;
using detail::Table;
using detail::Visit;

Choice distance_choice(radio::Distance& distance) {
  static constexpr std::array<std::string_view, 5> kNames = {"euclidean", "manhattan", "sorensen",
                                                             "cosine", "sorensen_cosine"};
  return {kNames, [&distance] { return static_cast<std::size_t>(distance); },
          [&distance](std::size_t index) { distance = static_cast<radio::Distance>(index); }};
}

void visit_radio(Options& options, const Visit& visit) {
  Table("scan", visit)
      .number("max_age_s", options.scan.max_age_s, kAboveZero, 60.0,
              "Older Wi-Fi readings are left out of a scan.")
      .number("fresh_age_s", options.scan.fresh_age_s, kAboveZero, 60.0,
              "Readings this fresh date the scan; all of them do when none is.")
      .number("ble_window_s", options.scan.ble_window_s, 0.0, 60.0,
              "Bluetooth advertisements this recent join a scan; 0 leaves Bluetooth out.")
      .number("bluetooth_alone_after_s", options.bluetooth_alone_after_s, kAboveZero, kHuge,
              "Without Wi-Fi this long, Bluetooth is matched alone.");
  Table("matcher", visit)
      .choice("distance", distance_choice(options.matcher.distance), "How two scans are compared.")
      .number("floor_dbm", options.matcher.floor_dbm, -127.5, -50.5,
              "The RSSI that counts as just heard; set it to the weakest the phones report.")
      .number("exponent", options.matcher.exponent, kAboveZero, 10.0,
              "Strength = (share of the way from floor_dbm to 0)^exponent; more trusts loud ones.")
      .number("age_decay_per_s", options.matcher.age_decay_per_s, kAboveZero, 1.0,
              "Strength fades by this factor per second of age beyond one; 1 switches it off.");
  Table("wknn", visit)
      .number("neighbours", options.wknn.neighbours, 1, 200, "Nearest fingerprints averaged.")
      .number("floor_neighbours", options.wknn.floor_neighbours, 1, 200,
              "Nearest over all floors that vote for theirs; at most `neighbours`.")
      .number("weight_exponent", options.wknn.weight_exponent, 0.0, 20.0,
              "Weight = (nearest distance / distance)^exponent; 0 weighs all alike.")
      .number("base_sigma_m", options.wknn.base_sigma_m, kAboveZero, kHuge,
              "Error of a match per axis where all neighbours agree.")
      .number("spread_gain", options.wknn.spread_gain, 0.0, kHuge,
              "Share of the neighbours' scatter that adds to the error's covariance.")
      .number("min_readings", options.wknn.min_readings, 0, 10000,
              "Scans with fewer readings are not used.")
      .number("few_readings", options.wknn.few_readings, 0.0, kHuge,
              "Trust in a scan of n readings is n / (n + few_readings).")
      .number("floor_few_readings", options.wknn.floor_few_readings, 0.0, kHuge,
              "The same for its vote on the floor.")
      .number("walking_speed_mps", options.wknn.walking_speed_mps, 0.0, 100.0,
              "An ageing match's error grows this fast per axis; 0 lets it stay.")
      .number("fresh_for_s", options.wknn.fresh_for_s, 0.0, kHuge,
              "A match this young has not aged.");
}

void visit_places(radio::PlaceLikelihood::Options& places, const Visit& visit) {
  radio::SignalField::Options& signal = places.signal;
  Table("places", visit)
      .number("candidates", places.candidates, 1, 500, "Fingerprints that resemble a scan most.")
      .number("distance_scale", places.distance_scale, kAboveZero, kHuge,
              "A candidate counts exp(-(distance - least) / this).")
      .number("candidate_sigma_m", places.candidate_sigma_m, kAboveZero, kHuge,
              "Standard deviation of the kernel about each candidate.")
      .number("elsewhere_share", places.elsewhere_share, 0.000001, 0.999,
              "Of the candidates' likelihood, what is spread over the whole floor.")
      .number("candidates_weight", places.candidates_weight, 0.0, kHuge,
              "Power on the candidates' likelihood.")
      .number("signal_weight", places.signal_weight, 0.0, kHuge,
              "Power on the signal field's likelihood; 0 does without it.")
      .number("floor_window", places.floor_window, 0.0, kHuge,
              "Floors less likely by this much, as a logarithm, are not looked at.");
  Table("places.signal", visit)
      .number("node_m", signal.node_m, 0.5, 20.0, "Between the nodes of the raster.")
      .number("margin_m", signal.margin_m, 0.0, 200.0, "Raster around the survey.")
      .number("kernel_m", signal.kernel_m, kAboveZero, 50.0, "Sigma of the survey's kernel.")
      .number("fade_m", signal.fade_m, kAboveZero, 1000.0,
              "Distance from the survey over which doubt sets in.")
      .number("prior_weight", signal.prior_weight, kAboveZero, kHuge,
              "The path loss counts as this many fingerprints.")
      .number("prior_sigma_db", signal.prior_sigma_db, kAboveZero, kHuge, "Error of the path loss.")
      .number("min_sigma_db", signal.min_sigma_db, kAboveZero, kHuge,
              "What a moving phone's reading scatters at least.")
      .number("hearing_dbm", signal.hearing_dbm, -127.5, 0.0,
              "Expected strength that half of the scans hear.")
      .number("hearing_scale_db", signal.hearing_scale_db, kAboveZero, kHuge,
              "Over which hearing sets in.")
      .number("surprise_ratio", signal.surprise_ratio, kAboveZero, 0.2,
              "Probability of hearing what is not to be heard, or the reverse.")
      .number("effective_transmitters", signal.effective_transmitters, kAboveZero, kHuge,
              "A scan tells as much as this many independent transmitters.")
      .number("age_decay_per_s", signal.age_decay_per_s, kAboveZero, 1.0,
              "A reading's weight fades by this factor per second of age beyond one.");
}

void visit_response(radio::DeviceResponse::Options& response, const Visit& visit) {
  Table("response", visit)
      .number("prior_sigma_db", response.prior_sigma_db, kAboveZero, kHuge,
              "How much phones differ in what they hear; near 0 takes all for alike.")
      .number("scan_sigma_db", response.scan_sigma_db, kAboveZero, kHuge,
              "By which a whole scan errs: body, wrong place.")
      .number("drift_db", response.drift_db, 0.0, kHuge, "Random walk from scan to scan.")
      .number("feigned_db", response.feigned_db, 0.0, kHuge,
              "Only what exceeds it is taken from the readings.")
      .number("huber", response.huber, kAboveZero, kHuge,
              "Readings off by more sigmas pull no harder.")
      .number("min_readings", response.min_readings, 1, 10000,
              "Scans with fewer readings are passed over.");
}

void visit_plan(site::Walkability::Options& plan, const Visit& visit) {
  Table("plan", visit)
      .number("cell_m", plan.cell_m, 0.05, 2.0, "Of the raster of areas.")
      .number("softness_m", plan.softness_m, 0.05, 10.0,
              "Depth in an obstacle that costs 0.5; more where plans are less exact.")
      .number("wall_penalty", plan.wall_penalty, 0.0, 100.0, "For crossing walls in one step.")
      .number("max_penalty", plan.max_penalty, 0.0, 100.0,
              "A step never costs more; 0 ignores the plan.");
}

void visit_heading(pdr::HeadingFilter::Options& heading, const Visit& visit) {
  Table("pdr.heading", visit)
      .number("initial_sigma_rad", heading.initial_sigma_rad, kAboveZero, kHuge,
              "Doubt of the first compass heading.")
      .number("gyro_noise_rad_per_sqrt_s", heading.gyro_noise_rad_per_sqrt_s, kAboveZero, kHuge,
              "Drift of the gyroscope's heading, a random walk.")
      .number("initial_bias_sigma_radps", heading.initial_bias_sigma_radps, kAboveZero, kHuge,
              "Doubt of the gyroscope's bias at the start.")
      .number("bias_walk_radps_per_sqrt_s", heading.bias_walk_radps_per_sqrt_s, 0.0, kHuge,
              "How fast the gyroscope's bias wanders.")
      .number("compass_interval_s", heading.compass_interval_s, 0.0, kHuge,
              "The compass is asked at most this often.")
      .number("rotation_sigma_rad", heading.rotation_sigma_rad, kAboveZero, kHuge,
              "Error of the phone's rotation vector; less where the field is undisturbed.")
      .number("magnetometer_sigma_rad", heading.magnetometer_sigma_rad, kAboveZero, kHuge,
              "Error of the levelled field, used where there is no rotation vector.");
}

void visit_pdr(Options& options, const Visit& visit) {
  Table("pdr", visit)
      .number("step_heading_sigma_rad", options.pdr.step_heading_sigma_rad, kAboveZero, kHuge,
              "Sway and drift of the heading from one step to the next.")
      .number("step_length_sigma_ratio", options.pdr.step_length_sigma_ratio, kAboveZero, kHuge,
              "Variation of steps around the person's mean.");
  pdr::PressureClimb::Options& pressure = options.pressure;
  Table("pdr.pressure", visit)
      .number("averaging_s", pressure.averaging_s, kAboveZero, 10.0,
              "Air pressure is averaged over this long.")
      .number("drift_tau_s", pressure.drift_tau_s, kAboveZero, kHuge,
              "The height at rest follows what is measured this slowly, for the weather's sake.")
      .number("certain_climb_m", pressure.certain_climb_m, kAboveZero, 100.0,
              "This far off the height at rest, it is a climb.")
      .number("report_step_m", pressure.report_step_m, kAboveZero, 100.0,
              "A climb moves the floor again when it has gone this far on.")
      .number("least_rise_s", pressure.least_rise_s, 0.0, 60.0,
              "Most of a certain climb in less time are a jump of the pressure, as of a door.")
      .number("rest_s", pressure.rest_s, kAboveZero, 600.0, "A climb has ended when this long ...")
      .number("rest_band_m", pressure.rest_band_m, kAboveZero, 100.0,
              "... all heights lie within this of each other.")
      .number("sigma_m", pressure.sigma_m, kAboveZero, 100.0, "Error of a climb.")
      .number("longest_gap_s", pressure.longest_gap_s, kAboveZero, kHuge,
              "After a longer gap in the pressure all starts anew.");
  Table("pdr.gravity", visit)
      .number("accelerometer_tau_s", options.pdr.gravity.accelerometer_tau_s, kAboveZero, 60.0,
              "Longer: less of the walking bounce; shorter: less gyroscope drift.");
  visit_heading(options.pdr.heading, visit);
  Table("pdr.step", visit)
      .number("low_pass_hz", options.pdr.step.low_pass_hz, kAboveZero, 1000.0,
              "Cut-off of the smoothing; cadence is below 3 Hz.")
      .number("min_peak_mps2", options.pdr.step.min_peak_mps2, kAboveZero, 100.0,
              "Lower peaks are never steps; raise it when standing counts steps.")
      .number("relative_peak_ratio", options.pdr.step.relative_peak_ratio, 0.0, 0.999,
              "Of the recent peaks, what a new one must reach.")
      .number("shortest_interval_s", options.pdr.step.shortest_interval_s, kAboveZero, 10.0,
              "Between two steps.")
      .number("longest_interval_s", options.pdr.step.longest_interval_s, kAboveZero, 60.0,
              "A longer pause starts a new walk.");
  Table("pdr.stride", visit)
      .number("constant_m", options.pdr.stride.constant_m, -10.0, 10.0, "Part of every step.")
      .number("swing_gain", options.pdr.stride.swing_gain, 0.0, 10.0,
              "m per (m/s2)^(1/4) of vertical swing.")
      .number("cadence_gain_m_s", options.pdr.stride.cadence_gain_m_s, -10.0, 10.0,
              "m per Hz of cadence above 1.9 Hz.")
      .number("shortest_m", options.pdr.stride.shortest_m, kAboveZero, 10.0, "Shortest step told.")
      .number("longest_m", options.pdr.stride.longest_m, kAboveZero, 10.0, "Longest step told.");
}

void visit_planar(fusion::PlanarTracker::Options& planar, const Visit& visit) {
  Table("fused.planar", visit)
      .number("start_sigma_m", planar.start_sigma_m, kAboveZero, kHuge,
              "Doubt around the first scan's position before that scan is used.")
      .number("heading_offset_sigma_rad", planar.heading_offset_sigma_rad, kAboveZero, kHuge,
              "How far walking and phone headings may differ at the start.")
      .number("log_scale_sigma", planar.log_scale_sigma, kAboveZero, kHuge,
              "Spread of people's step lengths, as a logarithm.")
      .number("heading_offset_walk_rad_per_sqrt_step", planar.heading_offset_walk_rad_per_sqrt_step,
              0.0, kHuge, "How fast the heading offset changes.")
      .number("log_scale_walk_per_sqrt_step", planar.log_scale_walk_per_sqrt_step, 0.0, kHuge,
              "How fast a person's step length changes.")
      .number("position_walk_m_per_sqrt_s", planar.position_walk_m_per_sqrt_s, kAboveZero, kHuge,
              "Movement that no step tells; more for phones without motion sensors.")
      .number("radio_bias_sigma_m", planar.radio_bias_sigma_m, kAboveZero, kHuge,
              "The part of the radio error that persists from scan to scan.")
      .number("radio_bias_tau_s", planar.radio_bias_tau_s, kAboveZero, kHuge,
              "How long a radio error persists.")
      .number("radio_sigma_scale", planar.radio_sigma_scale, kAboveZero, kHuge,
              "Multiplies the error a scan states for itself.")
      .number("radio_degrees_of_freedom", planar.radio_degrees_of_freedom, kAboveZero, kHuge,
              "Of the Student-t error; small doubts far-off scans, large is Gaussian.")
      .number("lost_weight_ratio", planar.lost_weight_ratio, 0.0, 0.999,
              "Scans weighted below this on average mean the track is lost.")
      .number("lost_sigma_m", planar.lost_sigma_m, 0.0, kHuge, "Doubt added when lost.");
}

void visit_fused(Options& options, const Visit& visit) {
  visit_planar(options.fused.planar, visit);
  Table("fused.floor", visit)
      .number("storey_m", options.fused.floor.storey_m, kAboveZero, kHuge,
              "Usual height of a storey, m; climbs by air pressure are counted in it.")
      .number("storey_sigma_m", options.fused.floor.storey_sigma_m, kAboveZero, kHuge,
              "How much storeys differ, m.")
      .number("false_climb_ratio", options.fused.floor.false_climb_ratio, kAboveZero, 1.0,
              "Share of climbs by air pressure that are not what they seem.")
      .number("change_probability", options.fused.floor.change_probability, kAboveZero, 0.999,
              "Of leaving the floor between two scans.")
      .number("vote_weight", options.fused.floor.vote_weight, kAboveZero, kHuge,
              "On each scan's log-likelihood; below 1 since scans repeat each other's errors.");
  Table("fused.state", visit)
      .number("ok_radius_m", options.fused.state.ok_radius_m, kAboveZero, kHuge,
              "Semi-major axis of the 95 % region up to which a fix is `ok`.")
      .number("show_radius_m", options.fused.state.show_radius_m, kAboveZero, kHuge,
              "Beyond this axis a fix is `unknown`.")
      .number("floor_probability", options.fused.state.floor_probability, 0.0, 1.0,
              "With less, a fix is `low_confidence` at best.")
      .number("known_share_ratio", options.fused.state.known_share_ratio, 0.0, 1.0,
              "With less of the signal known to the map, a fix is `outside`.")
      .number("stale_after_s", options.fused.state.stale_after_s, kAboveZero, kHuge,
              "With no scan this near in time, a fix is `low_confidence` at best.")
      .number("lost_after_s", options.fused.state.lost_after_s, kAboveZero, kHuge,
              "With no scan this near in time, a fix is `unknown`; not less than stale_after_s.");
  auto& p = options.particles;
  Table("particles", visit)
      .number("particles", p.particles, 50, 100000, "Guesses that one phone costs.")
      .number("heading_offset_sigma_rad", p.heading_offset_sigma_rad, kAboveZero, kHuge,
              "How far walking and phone headings may differ at the start.")
      .number("heading_offset_walk_rad_per_sqrt_step", p.heading_offset_walk_rad_per_sqrt_step, 0.0,
              kHuge, "How fast the heading offset changes.")
      .number("log_scale_sigma", p.log_scale_sigma, 0.0, kHuge,
              "Spread of people's step lengths, as a logarithm.")
      .number("log_scale_walk_per_sqrt_step", p.log_scale_walk_per_sqrt_step, 0.0, kHuge,
              "How fast a person's step length changes.")
      .number("position_walk_m_per_sqrt_s", p.position_walk_m_per_sqrt_s, 0.0, kHuge,
              "Movement that no step tells.")
      .number("radio_bias_sigma_m", p.radio_bias_sigma_m, 0.0, kHuge,
              "The part of the radio error that persists from scan to scan.")
      .number("radio_bias_tau_s", p.radio_bias_tau_s, kAboveZero, kHuge,
              "How long a radio error persists.")
      .number("radio_trust", p.radio_trust, kAboveZero, 1.0, "Power on a scan's likelihood.")
      .number("jump_probability", p.jump_probability, 0.0, 0.999,
              "That between two scans the belief became void.")
      .number("resample_ratio", p.resample_ratio, 0.0, 1.0,
              "Below this share of effective particles they are redrawn.")
      .number("plan_trust", p.plan_trust, 0.0, kHuge, "Power on the plan's penalty.")
      .number("base_sigma_m", p.base_sigma_m, kAboveZero, kHuge,
              "Error per axis that no guess tells of.")
      .number("sigma_scale", p.sigma_scale, kAboveZero, kHuge,
              "On the spread of the guesses, so that regions hold.");
  Table("smoothing", visit)
      .number("particles", options.smoothing_particles, 50, 1000000, "Guesses of a whole track.")
      .number("horizon_s", options.smoothing_horizon_s, kAboveZero, kHuge,
              "How much of the future an instant knows at most.")
      .number("rounds", options.smoothing_rounds, 1, 50,
              "Passes over the track; scans are weighed again in each.");
}

Choice evidence_choice(survey::MovingTransmitterFilter::Evidence& evidence) {
  using Evidence = survey::MovingTransmitterFilter::Evidence;
  static constexpr std::array<std::string_view, 2> kNames = {"loud_places", "all"};
  return {kNames, [&evidence] { return static_cast<std::size_t>(evidence); },
          [&evidence](std::size_t index) { evidence = static_cast<Evidence>(index); }};
}

void visit_survey(Options& options, const Visit& visit) {
  Table("labels", visit)
      .number("widest_scale", options.labels.widest_scale, 1.000001, kHuge,
              "Steps may be this much longer or shorter than the marks say.")
      .number("shortest_shaped_m", options.labels.shortest_shaped_m, kAboveZero, kHuge,
              "Marks closer than this do not tell a direction.")
      .number("fastest_mps", options.labels.fastest_mps, kAboveZero, kHuge,
              "A stretch walked faster gives no labels.")
      .number("longest_gap_s", options.labels.longest_gap_s, kAboveZero, kHuge,
              "A longer stretch between marks gives no labels.")
      .number("mark_sigma_m", options.labels.mark_sigma_m, kAboveZero, kHuge,
              "Error of a mark per axis.")
      .number("drift_sigma_ratio", options.labels.drift_sigma_ratio, 0.0, kHuge,
              "Error of a label per metre from the nearer mark.");
  Table("moving", visit)
      .number("loud_dbm", options.moving.loud_dbm, -120.0, -0.5,
              "Heard this loudly, a transmitter is near.")
      .number("farthest_m", options.moving.farthest_m, kAboveZero, kHuge,
              "Loud places farther apart mean that it moves; it is left out of the map.")
      .choice("evidence", evidence_choice(options.moving_evidence),
              "What tells: loud places, or visits and path loss as well.");
  static constexpr std::array<std::string_view, 2> kWords = {"off", "on"};
  const auto on_off = [](bool& target) {
    return Choice{kWords, [&target] { return target ? std::size_t{1} : std::size_t{0}; },
                  [&target](std::size_t index) { target = index == 1; }};
  };
  Table("magnetic_survey", visit)
      .choice("build", on_off(options.magnetic_survey.build), "Make a magnetic map at all.")
      .number("spacing_m", options.magnetic_survey.spacing_m, kAboveZero, 100.0,
              "Of the walk that one reading averages.")
      .choice("align_walks", on_off(options.magnetic_survey.align_walks),
              "Take each phone's constant part away, where walks meet.")
      .number("cell_m", options.magnetic_survey.cells.cell_m, 0.05, 100.0,
              "Side of a cell of the map; smaller is sharper and larger.")
      .number("accelerometer_tau_s", options.magnetic_survey.gravity.accelerometer_tau_s,
              kAboveZero, 60.0, "Of levelling, as in [pdr.gravity].");
}

}  // namespace

void for_each_option(Options& options, const Visit& visit) {
  visit_radio(options, visit);
  visit_pdr(options, visit);
  detail::visit_gait_options(options, visit);
  visit_places(options.places, visit);
  visit_response(options.response, visit);
  visit_plan(options.walkability, visit);
  visit_fused(options, visit);
  detail::visit_paper_options(options, visit);
  visit_survey(options, visit);
}

}  // namespace waylode::pipeline
