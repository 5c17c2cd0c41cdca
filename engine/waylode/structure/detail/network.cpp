// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/structure/detail/network.hpp"

#include <algorithm>
#include <map>
#include <string>

namespace waylode::structure::detail {
namespace {

using core::Vector2;

std::vector<std::size_t> visits_per_place(const Places& places, const Layout& layout) {
  std::vector<std::size_t> visits(places.count());
  for (std::size_t w = 0; w < places.of.size(); ++w) {
    if (!layout.walks[w]) continue;
    for (const std::size_t place : places.of[w]) ++visits[place];
  }
  return visits;
}

std::size_t add_node(PoseGraph& graph, const Vector2& position_m) {
  graph.nodes_m.push_back(position_m);
  return graph.nodes_m.size() - 1;
}

void add_walk(const Walk& walk, std::size_t index, const Layout& layout,
              const std::vector<std::size_t>& visits, double tie_sigma_m, Network& network) {
  PoseGraph& graph = network.graph;
  const std::vector<Vector2> chain_m = chain_of(walk);
  for (std::size_t visit = 0; visit < chain_m.size(); ++visit) {
    const std::size_t place = network.places.of[index][visit];
    auto& place_node = network.place_nodes[place];
    if (!place_node) place_node = add_node(graph, *layout.places_m[place]);
    if (visits[place] == 1) {
      network.visit_nodes[index].push_back(*place_node);
      continue;
    }
    const std::size_t node = add_node(graph, *layout.walks[index] * chain_m[visit]);
    network.visit_nodes[index].push_back(node);
    graph.ties.push_back({*place_node, node, tie_sigma_m});
    network.tie_visits.emplace_back(place, Visit{index, visit});
  }
  for (std::size_t i = 0; i < walk.segments.size(); ++i) {
    const WalkedSegment& segment = walk.segments[i];
    graph.segments.push_back({network.visit_nodes[index][i], network.visit_nodes[index][i + 1],
                              index, segment.length_m, segment.length_sigma_m,
                              segment.direction_rad, segment.direction_sigma_rad});
  }
}

/// Starts where the first known distance holds.
void scale_to_distances(PoseGraph& graph) {
  constexpr double kLeast_m = 1.0;
  if (graph.distances.empty()) return;
  const DistanceTerm& known = graph.distances.front();
  const double now_m = (graph.nodes_m[known.b] - graph.nodes_m[known.a]).norm();
  if (now_m < kLeast_m) return;
  const double scale_ratio = known.metres / now_m;
  for (Vector2& node_m : graph.nodes_m) node_m *= scale_ratio;
  for (WalkState& walk : graph.walks) walk.reading_ratio /= scale_ratio;
  graph.common_ratio /= scale_ratio;
}

}  // namespace

std::optional<std::size_t> Network::node_of(std::string_view landmark) const {
  for (std::size_t place = 0; place < places.count(); ++place) {
    if (places.names[place] == landmark && place_nodes[place]) return place_nodes[place];
  }
  return std::nullopt;
}

Network build_network(const Survey& survey, const Places& places, const Layout& layout,
                      std::size_t base, const StructureAdjuster::Options& options) {
  Network network;
  network.places = places;
  network.visit_nodes.resize(survey.walks.size());
  network.place_nodes.resize(places.count());
  network.graph.walks.resize(survey.walks.size());
  const std::vector<std::size_t> visits = visits_per_place(places, layout);
  for (std::size_t w = 0; w < survey.walks.size(); ++w) {
    if (!layout.walks[w]) continue;
    network.graph.walks[w] = {layout.walks[w]->heading_offset_rad,
                              1.0 / layout.walks[w]->scale_ratio};
    add_walk(survey.walks[w], w, layout, visits, options.landmark_sigma_m, network);
  }
  for (const KnownDistance& known : survey.known_distances) {
    const auto from = network.node_of(known.from);
    const auto to = network.node_of(known.to);
    if (from && to) network.graph.distances.push_back({*from, *to, known.metres, known.sigma_m});
  }
  scale_to_distances(network.graph);
  network.graph.fixed_node = *network.place_nodes[places.of[base].front()];
  network.graph.fixed_walk = base;
  return network;
}

std::vector<Stretch> stretches_of(const Network& network) {
  std::vector<Stretch> stretches;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> known;
  for (std::size_t w = 0; w < network.visit_nodes.size(); ++w) {
    for (std::size_t i = 1; i < network.visit_nodes[w].size(); ++i) {
      const std::size_t from = *network.place_nodes[network.places.of[w][i - 1]];
      const std::size_t to = *network.place_nodes[network.places.of[w][i]];
      if (from == to) continue;
      const auto [entry, is_new] = known.try_emplace(std::minmax(from, to), stretches.size());
      if (is_new) stretches.push_back({from, to, 0});
      ++stretches[entry->second].walked;
    }
  }
  return stretches;
}

}  // namespace waylode::structure::detail
