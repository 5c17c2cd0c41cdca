// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <utility>

#include "waylode/core/angle.hpp"
#include "waylode/core/rng.hpp"
#include "waylode/experiment/bootstrap.hpp"
#include "waylode/experiment/effective_distance.hpp"
#include "waylode/experiment/paper_experiments.hpp"
#include "waylode/experiment/paper_rooms.hpp"
#include "waylode/structure/structure_adjuster.hpp"
#include "waylode/structure/walk_from_motion.hpp"

namespace waylode::experiment {
namespace {

using Validity = pdr::DeadReckoning::Validity;

/// How the steps that do not move are told, and how scattered a direction must be for it.
struct Rule {
  const char* label;
  Validity validity;
  double scatter_deg;
};
constexpr std::array<Rule, 5> kRules = {{
    {"aside and back again", Validity::kExcursion, 20.0},
    {"three-way rule, 20 degrees", Validity::kThreeWay, 20.0},
    {"three-way rule, 15 degrees", Validity::kThreeWay, 15.0},
    {"literal rule, 20 degrees", Validity::kLiteral, 20.0},
    {"no rule", Validity::kOff, 20.0},
}};

double error_pct(double told_m, double true_m) {
  return 100.0 * std::abs(told_m - true_m) / true_m;
}

/// Relative errors of one walk, one per rule, then speed integration's.
core::Result<std::vector<double>> errors_of_walk(const PaperWalk& walk) {
  const auto setting = calibrate_person(walk.calibration.samples, walk.calibration_steps,
                                        walk.calibration_length_m, walk.height_m);
  if (!setting) return tl::unexpected(setting.error());
  std::vector<double> errors;
  for (const Rule& rule : kRules) {
    pdr::DeadReckoning::Options options = setting->options;
    options.validity = rule.validity;
    options.step_validity.scatter_rad = core::radians_from_degrees(rule.scatter_deg);
    errors.push_back(error_pct(walked_m(walked_steps(walk.walk.samples, options)), walk.length_m));
  }
  errors.push_back(error_pct(integrated_m(walk.walk.samples), walk.length_m));
  return errors;
}

struct Kind {
  const char* name;
  ZhongKind kind;
  const char* id;
  const char* paper;
  double bar_pct;
};
constexpr std::array<Kind, 4> kKinds = {{
    {"straight", ZhongKind::kStraight, "D-X1", "4", 4.0},
    {"crowd", ZhongKind::kCrowd, "D-X1", "4", 4.0},
    {"turns", ZhongKind::kTurns, "D-X2", "", 4.0},
    {"photo", ZhongKind::kPhoto, "D-X2", "", 6.0},
}};

eval::LineChart rule_bars(const std::vector<Figure>& figures) {
  eval::LineChart chart;
  chart.title = "Mean absolute distance error with 95 % intervals";
  double most = 0.0;
  for (std::size_t i = 0; i < figures.size(); ++i) {
    eval::Series series;
    series.method = i;
    series.name = figures[i].what;
    series.points = {{static_cast<double>(i + 1), figures[i].ours.value}};
    series.half_widths = {0.5 * (figures[i].ours.high - figures[i].ours.low)};
    series.with_dots = true;
    series.with_line = false;
    most = std::max(most, figures[i].ours.high);
    chart.series.push_back(std::move(series));
  }
  chart.x = {"rule", "", static_cast<double>(figures.size() + 1), 1.0};
  chart.y = eval::axis_over(0.0, most, 6, "error (%)", "%");
  return chart;
}

core::Result<Outcome> distance(const Kind& kind, const SimulationRequest& request,
                               const core::ProgressSink& progress) {
  const std::size_t walks = walks_for_percentages(request);
  std::vector<std::vector<Unit>> errors(kRules.size() + 1);
  for (std::size_t walk = 0; walk < walks; ++walk) {
    const auto simulated = zhong_walk(kind.kind, request.first_seed + walk);
    if (!simulated) return tl::unexpected(simulated.error());
    const auto told = errors_of_walk(*simulated);
    if (!told) return tl::unexpected(told.error());
    for (std::size_t r = 0; r < errors.size(); ++r) errors[r].push_back({(*told)[r]});
    if (progress) progress(walk + 1, walks);
  }
  Outcome outcome;
  outcome.paper = "zhong2017";
  outcome.title = std::string("Effective displacement, ") + kind.name;
  outcome.data = "simulation, 50 m, " + std::to_string(walks) +
                 " persons, each calibrated on 30 m with counted steps";
  for (std::size_t r = 0; r < kRules.size(); ++r) {
    Figure figure;
    figure.id = kind.id;
    figure.what = std::string("distance error, ") + kRules[r].label;
    figure.unit = std::string("%");
    figure.ours = bootstrap(errors[r], mean_of);
    if (r == 0) {  // One rule for all kinds of walk is judged.
      figure.paper = kind.paper;
      figure.bar = Bar{Bar::Sense::kAtMost, kind.bar_pct};
    }
    outcome.figures.push_back(figure);
  }
  outcome.charts.push_back(rule_bars(outcome.figures));
  Figure integrated;
  integrated.id = "D-X4";
  integrated.what = "distance error, speed integration";
  integrated.unit = std::string("%");
  integrated.ours = bootstrap(errors.back(), mean_of);
  integrated.note = "the paper's table of other methods is missing from its text";
  outcome.figures.push_back(integrated);
  return outcome;
}

/// The corner points of the turning walk, by the names they get here.
constexpr std::array<const char*, 4> kPlaces = {"start", "first corner", "second corner", "end"};

/// A turning walk as segments with its corners named; nullopt when it is not in three segments.
core::Result<std::optional<structure::Walk>> named_walk(const PaperWalk& walk, bool back) {
  const auto setting = calibrate_person(walk.calibration.samples, walk.calibration_steps,
                                        walk.calibration_length_m, walk.height_m);
  if (!setting) return tl::unexpected(setting.error());
  pdr::DeadReckoning::Options options = setting->options;
  options.validity = Validity::kExcursion;
  auto segments = structure::walk_from_motion(walked_steps(walk.walk.samples, options), {}, {});
  if (!segments) return tl::unexpected(segments.error());
  if (segments->segments.size() + 1 != kPlaces.size()) return std::optional<structure::Walk>();
  for (std::size_t i = 0; i + 1 < kPlaces.size(); ++i) {
    const auto place = [back](std::size_t met) {
      return kPlaces[back ? kPlaces.size() - 1 - met : met];
    };
    segments->segments[i].begin_landmark = place(i);
    segments->segments[i].end_landmark = place(i + 1);
  }
  return std::optional(*std::move(segments));
}

/// Of three segments: mean relative length error in per cent, mean deviation of the corners in
/// degrees.
struct ShapeError {
  double length_pct = 0.0;
  double corner_deg = 0.0;
};

ShapeError shape_error(const std::array<core::Vector2, 4>& told_m,
                       const std::vector<core::Vector2>& true_m) {
  ShapeError error;
  for (std::size_t i = 0; i < 3; ++i) {
    const double true_length_m = (true_m[i + 1] - true_m[i]).norm();
    error.length_pct += error_pct((told_m[i + 1] - told_m[i]).norm(), true_length_m) / 3.0;
  }
  const auto turn_rad = [](const core::Vector2& a, const core::Vector2& b, const core::Vector2& c) {
    const core::Vector2 in = b - a;
    const core::Vector2 out = c - b;
    return core::wrap_angle(std::atan2(out.y(), out.x()) - std::atan2(in.y(), in.x()));
  };
  for (std::size_t i = 0; i < 2; ++i) {
    const double difference_rad =
        core::wrap_angle(turn_rad(told_m[i], told_m[i + 1], told_m[i + 2]) -
                         turn_rad(true_m[i], true_m[i + 1], true_m[i + 2]));
    error.corner_deg += 0.5 * core::degrees_from_radians(std::abs(difference_rad));
  }
  return error;
}

std::array<core::Vector2, 4> corners_of(const structure::Walk& walk) {
  std::array<core::Vector2, 4> corners;
  corners[0].setZero();
  for (std::size_t i = 0; i < 3; ++i) {
    const structure::WalkedSegment& segment = walk.segments[i];
    corners[i + 1] = corners[i] + segment.length_m * core::Vector2(std::cos(segment.direction_rad),
                                                                   std::sin(segment.direction_rad));
  }
  return corners;
}

/// Ten walks in one adjustment, the first segment's length known.
core::Result<ShapeError> adjusted_error(const std::vector<structure::Walk>& walks,
                                        const std::vector<core::Vector2>& route_m,
                                        bool right_angles) {
  structure::Survey survey;
  survey.walks = walks;
  survey.known_distances.push_back({kPlaces[0], kPlaces[1], (route_m[1] - route_m[0]).norm()});
  structure::StructureAdjuster::Options options;
  if (!right_angles) options.corner_sigma_rad = options.parallel_sigma_rad = 0.0;
  const auto adjusted = structure::StructureAdjuster(options).adjust(survey);
  if (!adjusted) return tl::unexpected(adjusted.error());
  std::array<core::Vector2, 4> corners;
  for (std::size_t place = 0; place < kPlaces.size(); ++place) {
    for (const structure::StructureNode& node : adjusted->nodes) {
      if (node.landmark == kPlaces[place]) corners[place] = node.position_m;
    }
  }
  return shape_error(corners, route_m);
}

Figure shape_figure(const std::string& what, const std::string& unit,
                    const std::vector<Unit>& errors) {
  Figure figure;
  figure.id = "D-X3";
  figure.what = what;
  figure.unit = unit;
  figure.ours = bootstrap(errors, mean_of);
  return figure;
}

/// Errors of single walks and of groups of ten, adjusted; one unit each.
struct GroupErrors {
  std::vector<Unit> single_length_pct;
  std::vector<Unit> single_corner_deg;
  std::vector<Unit> many_length_pct;
  std::vector<Unit> many_corner_deg;
  std::size_t tried = 0;
  std::size_t unusable = 0;  ///< Walks that did not fall into three segments.
};

struct GroupRule {
  bool both_ways = true;  ///< Half of them walk back: what starting and stopping does then cancels.
  bool right_angles = true;  ///< The adjustment prefers them.
};

/// Ten more walks that fall into three segments; `route_m` is their way.
core::Result<std::vector<structure::Walk>> next_group(const GroupRule& rule, std::uint64_t& seed,
                                                      std::vector<core::Vector2>& route_m,
                                                      GroupErrors& errors) {
  constexpr std::size_t kPerGroup = 10;
  constexpr std::size_t kMostTries = 200;
  std::vector<structure::Walk> walks;
  for (std::size_t tries = 0; walks.size() < kPerGroup; ++tries) {
    if (tries == kMostTries) {
      return core::fail(core::ErrorCode::kSurveyInsufficient,
                        "hardly any walk falls into three segments", "zhong2017");
    }
    const bool back = rule.both_ways && walks.size() % 2 == 1;
    const auto simulated = zhong_walk(back ? ZhongKind::kTurnsBack : ZhongKind::kTurns, seed++);
    if (!simulated) return tl::unexpected(simulated.error());
    if (!back) route_m = simulated->route_m;
    const auto named = named_walk(*simulated, back);
    if (!named) return tl::unexpected(named.error());
    ++errors.tried;
    if (!*named) {
      ++errors.unusable;
      continue;
    }
    const ShapeError alone = shape_error(corners_of(**named), simulated->route_m);
    errors.single_length_pct.push_back({alone.length_pct});
    errors.single_corner_deg.push_back({alone.corner_deg});
    walks.push_back(**named);
  }
  return walks;
}

core::Result<GroupErrors> adjust_groups(const SimulationRequest& request, const GroupRule& rule) {
  GroupErrors errors;
  // Beyond the seeds of the single walks.
  std::uint64_t seed = request.first_seed + 100'000;
  for (std::size_t group = 0; group < request.seeds; ++group) {
    std::vector<core::Vector2> route_m;
    const auto walks = next_group(rule, seed, route_m, errors);
    if (!walks) return tl::unexpected(walks.error());
    const auto together = adjusted_error(*walks, route_m, rule.right_angles);
    if (!together) return tl::unexpected(together.error());
    errors.many_length_pct.push_back({together->length_pct});
    errors.many_corner_deg.push_back({together->corner_deg});
  }
  return errors;
}

core::Result<Outcome> many_walks(const SimulationRequest& request,
                                 const core::ProgressSink& progress) {
  const auto both_ways = adjust_groups(request, {true, true});
  if (!both_ways) return tl::unexpected(both_ways.error());
  if (progress) progress(1, 3);
  const auto evidence = adjust_groups(request, {true, false});
  if (!evidence) return tl::unexpected(evidence.error());
  if (progress) progress(2, 3);
  const auto one_way = adjust_groups(request, {false, true});
  if (!one_way) return tl::unexpected(one_way.error());
  if (progress) progress(3, 3);

  Outcome outcome;
  outcome.paper = "zhong2017";
  outcome.title = "Ten walks adjusted into one structure";
  outcome.data = "simulation, " + std::to_string(request.seeds) +
                 " groups of ten persons on 20 m + 15 m + 15 m with two corners, the first length "
                 "known";
  const std::string percent = "%";
  const std::string degrees = "degrees";
  outcome.figures = {
      shape_figure("length error, one walk", percent, both_ways->single_length_pct),
      shape_figure("corner error, one walk", degrees, both_ways->single_corner_deg),
      shape_figure("length error, ten, both ways", percent, both_ways->many_length_pct),
      shape_figure("corner error, ten, both ways", degrees, both_ways->many_corner_deg),
      shape_figure("corner error, no right angles preferred", degrees, evidence->many_corner_deg),
      shape_figure("length error, ten, all one way", percent, one_way->many_length_pct),
      shape_figure("corner error, ten, all one way", degrees, one_way->many_corner_deg)};
  outcome.figures[2].paper = "2";
  outcome.figures[2].bar = Bar{Bar::Sense::kAtMost, 2.0};
  outcome.figures[3].paper = "1.5 %";
  outcome.figures[3].bar = Bar{Bar::Sense::kAtMost, 1.4};
  outcome.figures[5].note = "start and stop lengthen the first stretch and shorten the last";
  outcome.notes.push_back(std::to_string(both_ways->unusable) + " of " +
                          std::to_string(both_ways->tried) +
                          " walks did not fall into three segments and were left out.");
  return outcome;
}

}  // namespace

core::Result<std::vector<Outcome>> run_zhong2017(const SimulationRequest& request,
                                                 const core::ProgressSink& progress) {
  std::vector<Outcome> outcomes;
  for (const Kind& kind : kKinds) {
    if (request.preset && *request.preset != kind.name) continue;
    auto outcome = distance(kind, request, progress);
    if (!outcome) return tl::unexpected(outcome.error());
    outcomes.push_back(*std::move(outcome));
  }
  if (!request.preset || *request.preset == "many") {
    auto outcome = many_walks(request, progress);
    if (!outcome) return tl::unexpected(outcome.error());
    outcomes.push_back(*std::move(outcome));
  }
  return outcomes;
}

}  // namespace waylode::experiment
