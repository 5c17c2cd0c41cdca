// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "waylode/structure/detail/layout.hpp"
#include "waylode/structure/detail/places.hpp"
#include "waylode/structure/detail/pose_graph.hpp"
#include "waylode/structure/structure_adjuster.hpp"

namespace waylode::structure::detail {

/// The pose graph of the walks that a layout reaches, and what its parts stand for. A place that
/// was met once is its visit's node; one met more often has a node of its own, tied to its visits'.
struct Network {
  Places places;
  PoseGraph graph;
  std::vector<std::vector<std::size_t>> visit_nodes;      ///< Per walk; empty when not reached.
  std::vector<std::optional<std::size_t>> place_nodes;    ///< Per place.
  std::vector<std::pair<std::size_t, Visit>> tie_visits;  ///< As graph.ties: place and visit.

  /// The node of the place of this name.
  std::optional<std::size_t> node_of(std::string_view landmark) const;
};

Network build_network(const Survey& survey, const Places& places, const Layout& layout,
                      std::size_t base, const StructureAdjuster::Options& options);

/// A segment's places: the corridor it went along.
struct Stretch {
  std::size_t from = 0;  ///< Nodes of places.
  std::size_t to = 0;
  std::size_t walked = 0;
};

/// Every pair of different places that a segment joins, once, as first walked.
std::vector<Stretch> stretches_of(const Network& network);

/// Adds what is nearly regular now: right angles between successive segments, parallel stretches.
void add_regularities(Network& network, const StructureAdjuster::Options& options);

/// Pairs of places that lie so near each other, for how exactly that is known, that they must be
/// one: those that are each other's nearest, do not both have a name, and have corridors that run
/// along or square to each other. `covariance` as of covariance_of.
std::vector<Closure> find_closures(const Network& network, const Eigen::MatrixXd& covariance,
                                   const StructureAdjuster::Options& options);

/// The covariance of node b less node a.
core::Matrix2 gap_covariance(const Eigen::MatrixXd& covariance, std::size_t a, std::size_t b);

}  // namespace waylode::structure::detail
