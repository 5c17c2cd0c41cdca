// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/structure/detail/structure_report.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "waylode/core/angle.hpp"

namespace waylode::structure::detail {
namespace {

using core::Matrix2;
using core::Vector2;
using Eigen::Index;
using Eigen::MatrixXd;

/// Edges shorter than this have no direction and are not told.
constexpr double kLeastEdge_m = 1e-3;

/// Which node of the graph is which node of the structure.
struct Selection {
  std::vector<std::size_t> nodes;   ///< Of the graph, in the structure's order.
  std::vector<std::size_t> index;   ///< Per place, into nodes.
  std::vector<std::size_t> visits;  ///< Per node.
};

Selection select(const Network& network) {
  constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  Selection selection;
  selection.index.assign(network.places.count(), kNone);
  for (std::size_t w = 0; w < network.visit_nodes.size(); ++w) {
    for (std::size_t visit = 0; visit < network.visit_nodes[w].size(); ++visit) {
      const std::size_t place = network.places.of[w][visit];
      if (selection.index[place] == kNone) {
        selection.index[place] = selection.nodes.size();
        selection.nodes.push_back(*network.place_nodes[place]);
        selection.visits.push_back(0);
      }
      ++selection.visits[selection.index[place]];
    }
  }
  return selection;
}

/// Columns that a shift along x, along y and a rotation move the nodes by.
MatrixXd rigid_motions(const std::vector<Vector2>& nodes_m) {
  Vector2 centre_m = Vector2::Zero();
  for (const Vector2& node : nodes_m) centre_m += node / static_cast<double>(nodes_m.size());
  MatrixXd motions = MatrixXd::Zero(static_cast<Index>(2 * nodes_m.size()), 3);
  for (std::size_t i = 0; i < nodes_m.size(); ++i) {
    const Vector2 arm_m = nodes_m[i] - centre_m;
    const auto row = static_cast<Index>(2 * i);
    motions(row, 0) = 1.0;
    motions(row + 1, 1) = 1.0;
    motions(row, 2) = -arm_m.y();
    motions(row + 1, 2) = arm_m.x();
  }
  return motions;
}

/// The selected nodes' covariance, turned by the same rotation as they, without the part of it that
/// moves all of them as one: what the choice of the fixed node and walk has put there.
MatrixXd inner_covariance(const MatrixXd& covariance, const Selection& selection,
                          const std::vector<Vector2>& nodes_m, const Matrix2& rotation) {
  const std::size_t count = selection.nodes.size();
  MatrixXd inner(2 * count, 2 * count);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < count; ++j) {
      const Matrix2 block = covariance.block<2, 2>(static_cast<Index>(2 * selection.nodes[i]),
                                                   static_cast<Index>(2 * selection.nodes[j]));
      inner.block<2, 2>(static_cast<Index>(2 * i), static_cast<Index>(2 * j)) =
          rotation * block * rotation.transpose();
    }
  }
  const MatrixXd motions = rigid_motions(nodes_m);
  const MatrixXd project =
      MatrixXd::Identity(inner.rows(), inner.cols()) -
      motions * (motions.transpose() * motions).ldlt().solve(motions.transpose());
  return project * inner * project.transpose();
}

void add_nodes(const Network& network, const Selection& selection, const Survey& survey,
               const std::vector<Vector2>& nodes_m, AdjustedStructure& structure) {
  for (std::size_t i = 0; i < nodes_m.size(); ++i) {
    StructureNode node;
    node.position_m = nodes_m[i];
    node.visits = selection.visits[i];
    structure.nodes.push_back(node);
  }
  for (std::size_t place = 0; place < network.places.count(); ++place) {
    if (!network.place_nodes[place]) continue;
    structure.nodes[selection.index[place]].landmark = network.places.names[place];
  }
  for (const LandmarkNote& note : survey.notes) {
    const auto node = std::ranges::find(structure.nodes, note.landmark, &StructureNode::landmark);
    if (note.landmark.empty() || node == structure.nodes.end()) {
      structure.notes.push_back("no landmark " + note.landmark + " for the note: " + note.text);
    } else {
      node->notes.push_back(note.text);
    }
  }
}

void add_edges(const Network& network, const Selection& selection, AdjustedStructure& structure) {
  std::vector<std::size_t> index_of_node(network.graph.nodes_m.size());
  for (std::size_t i = 0; i < selection.nodes.size(); ++i) index_of_node[selection.nodes[i]] = i;
  for (const Stretch& stretch : stretches_of(network)) {
    StructureEdge edge;
    edge.from = index_of_node[stretch.from];
    edge.to = index_of_node[stretch.to];
    edge.walked = stretch.walked;
    const Vector2 way_m =
        structure.nodes[edge.to].position_m - structure.nodes[edge.from].position_m;
    edge.length_m = way_m.norm();
    edge.direction_rad = core::wrap_angle(std::atan2(way_m.y(), way_m.x()));
    if (edge.length_m >= kLeastEdge_m) structure.edges.push_back(edge);
  }
}

void add_accuracy(const MatrixXd& inner, AdjustedStructure& structure) {
  for (std::size_t i = 0; i < structure.nodes.size(); ++i) {
    const auto at = static_cast<Index>(2 * i);
    const Matrix2 block = inner.block<2, 2>(at, at);
    structure.nodes[i].covariance_m2 = 0.5 * (block + block.transpose());
  }
  for (StructureEdge& edge : structure.edges) {
    const Matrix2 covariance_m2 = gap_covariance(inner, edge.from, edge.to);
    const Vector2 along(std::cos(edge.direction_rad), std::sin(edge.direction_rad));
    const Vector2 across(-along.y(), along.x());
    edge.length_sigma_m = std::sqrt(std::max(0.0, along.dot(covariance_m2 * along)));
    edge.direction_sigma_rad =
        std::sqrt(std::max(0.0, across.dot(covariance_m2 * across))) / edge.length_m;
  }
}

void add_walks(const Survey& survey, const Network& network, const Selection& selection,
               double turn_rad, AdjustedStructure& structure) {
  for (std::size_t w = 0; w < survey.walks.size(); ++w) {
    AdjustedWalk walk;
    const std::string name = "walk " + std::to_string(w);
    if (survey.walks[w].segments.empty()) {
      structure.notes.push_back(name + " has no segment and was left out");
    } else if (network.visit_nodes[w].empty()) {
      structure.notes.push_back(name +
                                " shares fewer than two places with the others and was left out; "
                                "name landmarks on it");
    } else {
      const WalkState& state = network.graph.walks[w];
      walk.used = true;
      walk.heading_offset_rad = core::wrap_angle(state.heading_offset_rad + turn_rad);
      walk.scale_ratio = 1.0 / state.reading_ratio;
      for (const std::size_t place : network.places.of[w]) {
        walk.nodes.push_back(selection.index[place]);
      }
    }
    structure.walks.push_back(std::move(walk));
  }
}

/// Of each walk's scale, and of what all share: the mean of the used ones.
void add_scale_accuracy(const MatrixXd& covariance, std::size_t node_count,
                        AdjustedStructure& structure) {
  double sum = 0.0;
  double used = 0.0;
  const auto at = [&](std::size_t w) { return static_cast<Index>(2 * node_count + 2 * w + 1); };
  for (std::size_t a = 0; a < structure.walks.size(); ++a) {
    AdjustedWalk& walk = structure.walks[a];
    if (!walk.used) continue;
    // A reading ratio's sigma, carried over to its inverse.
    walk.scale_sigma_ratio =
        std::sqrt(std::max(0.0, covariance(at(a), at(a)))) * walk.scale_ratio * walk.scale_ratio;
    used += 1.0;
    for (std::size_t b = 0; b < structure.walks.size(); ++b) {
      if (structure.walks[b].used) sum += covariance(at(a), at(b));
    }
  }
  structure.scale_sigma_ratio = std::sqrt(std::max(0.0, sum)) / used;
}

void note_unused_distances(const Survey& survey, const Network& network,
                           AdjustedStructure& structure) {
  for (const KnownDistance& known : survey.known_distances) {
    if (network.node_of(known.from) && network.node_of(known.to)) continue;
    structure.notes.push_back("the distance " + known.from + ":" + known.to +
                              " is to a landmark of a walk that was left out");
  }
  if (structure.scale_known) return;
  structure.notes.push_back(
      "no known distance: all lengths share an unknown factor; measure one between two landmarks");
}

}  // namespace

core::Result<AdjustedStructure> report(const Survey& survey, const Network& network,
                                       const SolveSummary& summary, std::vector<Closure> found,
                                       std::vector<Closure> rejected,
                                       const PoseGraphOptions& options) {
  const Selection selection = select(network);
  const auto stretches = stretches_of(network);
  if (stretches.empty()) {
    return core::fail(core::ErrorCode::kSurveyInsufficient,
                      "no walk leads from one place to another; walk a longer way");
  }
  const auto& graph = network.graph;
  const Vector2 first_m =
      graph.nodes_m[stretches.front().to] - graph.nodes_m[stretches.front().from];
  const double turn_rad = -std::atan2(first_m.y(), first_m.x());
  const Matrix2 rotation = Eigen::Rotation2Dd(turn_rad).toRotationMatrix();
  const Vector2 origin_m = graph.nodes_m[selection.nodes.front()];
  std::vector<Vector2> nodes_m;
  for (const std::size_t node : selection.nodes) {
    nodes_m.emplace_back(rotation * (graph.nodes_m[node] - origin_m));
  }

  AdjustedStructure structure;
  structure.scale_known = !graph.distances.empty();
  structure.converged = summary.converged;
  structure.cost = summary.cost;
  structure.degrees_of_freedom = summary.degrees_of_freedom;
  structure.found = std::move(found);
  structure.rejected = std::move(rejected);
  structure.notes = network.places.notes;
  add_nodes(network, selection, survey, nodes_m, structure);
  add_edges(network, selection, structure);
  add_walks(survey, network, selection, turn_rad, structure);
  note_unused_distances(survey, network, structure);
  const MatrixXd covariance = covariance_of(graph, options);
  if (covariance.size() == 0) {
    structure.notes.emplace_back("the accuracy could not be told: not all places are determined");
    return structure;
  }
  add_accuracy(inner_covariance(covariance, selection, nodes_m, rotation), structure);
  add_scale_accuracy(covariance, graph.nodes_m.size(), structure);
  return structure;
}

}  // namespace waylode::structure::detail
