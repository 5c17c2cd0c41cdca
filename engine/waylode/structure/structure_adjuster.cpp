// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/structure/structure_adjuster.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "waylode/core/covariance.hpp"
#include "waylode/structure/detail/network.hpp"
#include "waylode/structure/detail/structure_report.hpp"

namespace waylode::structure {
namespace {

using core::Matrix2;
using core::Result;
using core::Vector2;
using detail::Findings;
using detail::Layout;
using detail::Network;
using Options = StructureAdjuster::Options;

/// Rounds of rejecting one closure, and of finding new ones.
constexpr std::size_t kMaxRejections = 100;
constexpr int kMaxSearches = 3;
/// A start that closes all loops before it doubts any has losses as wide as this at first, and
/// narrows them by this factor.
constexpr double kWidest_m = 20.0;
constexpr double kNarrowing = 6.0;
/// Of the closures with the largest gaps, so many are questioned; the others hold.
constexpr std::size_t kQuestioned = 8;
/// A tie is not questioned when it is stretched by less than this many sigmas.
constexpr double kTaut_sigma = 0.5;

detail::PoseGraphOptions graph_options(const Options& options) {
  return {options.scale_sigma_ratio,  options.person_sigma_ratio, options.segment_loss_sigma,
          options.closure_loss_sigma, options.corner_sigma_rad,   options.parallel_sigma_rad};
}

struct Solution {
  Network network;
  detail::SolveSummary summary;
};

void keep_better(std::optional<Solution>& best, Solution solution) {
  constexpr double kClearly = 1.0 - 1e-9;
  if (!best || solution.summary.cost < kClearly * best->summary.cost) best = std::move(solution);
}

/// Walks in the largest group that hangs together, in order: the bases to start from.
std::vector<std::size_t> bases_of(const Survey& survey, const detail::Places& places) {
  std::vector<bool> seen(survey.walks.size());
  std::vector<std::size_t> largest;
  for (std::size_t base = 0; base < survey.walks.size(); ++base) {
    if (survey.walks[base].segments.empty() || seen[base]) continue;
    const Layout layout = detail::lay_out(survey.walks, places, base);
    std::vector<std::size_t> group;
    for (std::size_t w = 0; w < layout.walks.size(); ++w) {
      if (!layout.walks[w]) continue;
      seen[w] = true;
      group.push_back(w);
    }
    if (group.size() > largest.size()) largest = std::move(group);
  }
  return largest;
}

/// The best of several starts: chained to each base, with closures doubted from the beginning or
/// only in the end.
Solution solve_from_all_starts(const Survey& survey, const detail::Places& places,
                               const std::vector<std::size_t>& bases, const Options& options) {
  const detail::PoseGraphOptions final_options = graph_options(options);
  std::optional<Solution> best;
  const std::size_t reached = detail::lay_out(survey.walks, places, bases.front()).reached();
  for (std::size_t i = 0; i < std::min(options.starts, bases.size()); ++i) {
    const Layout layout = detail::lay_out(survey.walks, places, bases[i]);
    if (layout.reached() < reached) continue;
    Solution start{detail::build_network(survey, places, layout, bases[i], options), {}};
    Solution doubting = start;
    doubting.summary = detail::solve(doubting.network.graph, final_options);
    keep_better(best, std::move(doubting));
    detail::PoseGraphOptions wide = final_options;
    wide.tie_loss_sigma = std::max(wide.tie_loss_sigma, kWidest_m / options.landmark_sigma_m);
    for (; wide.tie_loss_sigma > final_options.tie_loss_sigma; wide.tie_loss_sigma /= kNarrowing) {
      detail::solve(start.network.graph, wide);
    }
    start.summary = detail::solve(start.network.graph, final_options);
    keep_better(best, std::move(start));
  }
  return *std::move(best);
}

double stretched_sigma(const detail::PoseGraph& graph, const detail::TieTerm& tie) {
  return (graph.nodes_m[tie.b] - graph.nodes_m[tie.a]).norm() / tie.sigma_m;
}

/// The ties under most tension, worst first; of equal ones the later visit.
std::vector<std::size_t> taut_ties(const detail::PoseGraph& graph) {
  std::vector<std::size_t> ties;
  for (std::size_t i = graph.ties.size(); i-- > 0;) {
    if (stretched_sigma(graph, graph.ties[i]) > kTaut_sigma) ties.push_back(i);
  }
  std::ranges::stable_sort(ties, [&](std::size_t a, std::size_t b) {
    return stretched_sigma(graph, graph.ties[a]) > stretched_sigma(graph, graph.ties[b]);
  });
  if (ties.size() > kQuestioned) ties.resize(kQuestioned);
  return ties;
}

struct Contradiction {
  double chi_square = 0.0;
  double gap_m = 0.0;
};

/// What the rest says of a tie: the gap without it, against how exactly that gap is then known.
Contradiction contradiction_of(const Network& network, std::size_t tie, const Options& options) {
  detail::PoseGraph graph = network.graph;
  const detail::TieTerm term = graph.ties[tie];
  graph.ties.erase(graph.ties.begin() + static_cast<std::ptrdiff_t>(tie));
  detail::solve(graph, graph_options(options));
  const Eigen::MatrixXd covariance = detail::covariance_of(graph, graph_options(options));
  if (covariance.size() == 0) return {};  // Nothing else holds that end.
  const Vector2 gap_m = graph.nodes_m[term.b] - graph.nodes_m[term.a];
  const Matrix2 allowed_m2 = detail::gap_covariance(covariance, term.a, term.b) +
                             term.sigma_m * term.sigma_m * Matrix2::Identity();
  return {core::squared_mahalanobis(gap_m, allowed_m2), gap_m.norm()};
}

Visit first_other_visit(const Network& network, std::size_t place, const Visit& visit) {
  for (const auto& [other_place, other] : network.tie_visits) {
    if (other_place == place && !(other == visit)) return other;
  }
  return visit;
}

/// The closure that the rest contradicts most, if any beyond the limit.
std::optional<Closure> worst_closure(const Network& network, const Options& options) {
  constexpr double kClearly = 1.0 + 1e-6;
  double worst = options.rejection_chi_square;
  std::optional<Closure> found;
  for (const std::size_t tie : taut_ties(network.graph)) {
    const Contradiction contradiction = contradiction_of(network, tie, options);
    if (!(contradiction.chi_square > kClearly * worst)) continue;
    worst = contradiction.chi_square;
    const auto& [place, visit] = network.tie_visits[tie];
    found = Closure{first_other_visit(network, place, visit), visit, network.places.names[place],
                    contradiction.gap_m};
  }
  return found;
}

/// Solves and sets visits apart until no closure is contradicted.
Solution solve_without_wrong_closures(const Survey& survey, const Options& options,
                                      Findings& findings, std::vector<Closure>& rejected) {
  while (true) {
    const detail::Places places = detail::associate(survey.walks, findings, options);
    Solution solution = solve_from_all_starts(survey, places, bases_of(survey, places), options);
    if (rejected.size() >= kMaxRejections) return solution;
    const auto wrong = worst_closure(solution.network, options);
    if (!wrong) return solution;
    findings.apart.push_back(wrong->second);
    rejected.push_back(*wrong);
  }
}

void drop_rejected(const Findings& findings, std::vector<Closure>& closures) {
  const auto is_apart = [&](const Visit& visit) {
    return std::ranges::find(findings.apart, visit) != findings.apart.end();
  };
  std::erase_if(closures, [&](const Closure& closure) {
    return is_apart(closure.first) || is_apart(closure.second);
  });
}

Result<void> check_leads_somewhere(const Survey& survey) {
  for (const Walk& walk : survey.walks) {
    for (const WalkedSegment& segment : walk.segments) {
      if (segment.length_m > 0.0) return {};
    }
  }
  return core::fail(core::ErrorCode::kSurveyInsufficient,
                    "no walk leads anywhere; record walks of at least one straight stretch");
}

}  // namespace

Result<AdjustedStructure> StructureAdjuster::adjust(const Survey& survey) const {
  if (auto checked = options_.validate(); !checked) return tl::unexpected(checked.error());
  if (auto checked = survey.validate(); !checked) return tl::unexpected(checked.error());
  if (auto checked = check_leads_somewhere(survey); !checked) {
    return tl::unexpected(checked.error());
  }
  Findings findings;
  std::vector<Closure> rejected;
  std::vector<Closure> found;
  Solution solution = solve_without_wrong_closures(survey, options_, findings, rejected);
  for (int search = 0; options_.find_closures && search < kMaxSearches; ++search) {
    const auto covariance = detail::covariance_of(solution.network.graph, graph_options(options_));
    if (covariance.size() == 0) break;
    auto closures = detail::find_closures(solution.network, covariance, options_);
    drop_rejected(findings, closures);
    if (closures.empty()) break;
    for (const Closure& closure : closures) {
      findings.together.emplace_back(closure.first, closure.second);
      found.push_back(closure);
    }
    solution = solve_without_wrong_closures(survey, options_, findings, rejected);
  }
  drop_rejected(findings, found);
  detail::add_regularities(solution.network, options_);
  solution.summary = detail::solve(solution.network.graph, graph_options(options_));
  return detail::report(survey, solution.network, solution.summary, std::move(found),
                        std::move(rejected), graph_options(options_));
}

namespace {

struct Range {
  const char* name;
  double value;
  double least;
  double greatest;
};

}  // namespace

Result<void> StructureAdjuster::Options::validate() const {
  const Range ranges[] = {
      {"scale_sigma_ratio", scale_sigma_ratio, 0.001, 0.5},
      {"person_sigma_ratio", person_sigma_ratio, 0.001, 0.5},
      {"landmark_sigma_m", landmark_sigma_m, 0.001, 5.0},
      {"segment_loss_sigma", segment_loss_sigma, 0.5, 100.0},
      {"closure_loss_sigma", closure_loss_sigma, 0.5, 100.0},
      {"rejection_chi_square", rejection_chi_square, 5.0, 1000.0},
      {"route_turn_tolerance_rad", route_turn_tolerance_rad, 0.0, 0.7},
      {"route_length_tolerance_ratio", route_length_tolerance_ratio, 0.0, 1.0},
      {"closure_sigma_m", closure_sigma_m, 0.001, 5.0},
      {"closure_reach_m", closure_reach_m, 0.0, 100.0},
      {"closure_gate_sigma", closure_gate_sigma, 0.0, 10.0},
      {"corner_sigma_rad", corner_sigma_rad, 0.0, 1.0},
      {"parallel_sigma_rad", parallel_sigma_rad, 0.0, 1.0},
      {"regular_tolerance_rad", regular_tolerance_rad, 0.0, 0.5},
      {"regular_least_m", regular_least_m, 0.01, 1000.0},
  };
  for (const Range& range : ranges) {
    if (range.value >= range.least && range.value <= range.greatest) continue;
    return core::fail(core::ErrorCode::kInvalidOptions,
                      std::string(range.name) + " is out of its range", "structure_adjuster");
  }
  if (route_least_segments < 2 || starts < 1 || starts > 100) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "need route_least_segments >= 2 and 1 to 100 starts", "structure_adjuster");
  }
  return {};
}

}  // namespace waylode::structure
