// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/smoothing/floor_chain.hpp"

#include <algorithm>
#include <ranges>
#include <utility>

namespace waylode::smoothing {
namespace {

using observation::RadioObservation;
using observation::VerticalMotion;

using Fits = std::vector<std::vector<double>>;

/// A scan's votes, and the climbs between the scan before and it, by floor from and floor to.
struct ChainLink {
  std::vector<double> log_likelihoods;
  std::vector<Fits> climbs;
};

Fits transposed(const Fits& fits) {
  Fits result = fits;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    for (std::size_t j = 0; j < fits.size(); ++j) result[i][j] = fits[j][i];
  }
  return result;
}

/// Forward-backward over the chain of floors: the posterior of each scan given all of them.
std::vector<std::vector<double>> smooth_chain(const std::vector<ChainLink>& links,
                                              double change_probability) {
  const std::size_t count = links.front().log_likelihoods.size();
  const std::vector<double> uniform(count, 1.0 / static_cast<double>(count));
  std::vector<std::vector<double>> posterior;
  for (const ChainLink& link : links) {
    std::vector<double> before = posterior.empty() ? uniform : posterior.back();
    for (const Fits& fits : link.climbs) before = fusion::climb_floor_chain(before, fits);
    posterior.push_back(
        fusion::advance_floor_chain(before, link.log_likelihoods, change_probability));
  }
  std::vector<double> future = uniform;  // Likelihood of what is still to come, per floor.
  for (std::size_t i = links.size(); i-- > 0;) {
    double total = 0.0;
    for (std::size_t floor = 0; floor < count; ++floor) {
      posterior[i][floor] *= future[floor];
      total += posterior[i][floor];
    }
    for (double& value : posterior[i]) value /= total;
    const std::vector<double> with_scan =
        fusion::advance_floor_chain(future, links[i].log_likelihoods, 0.0);
    // The chain is symmetric, so the step back is the step forward without a vote.
    future =
        fusion::advance_floor_chain(with_scan, std::vector<double>(count, 0.0), change_probability);
    for (const Fits& fits : std::views::reverse(links[i].climbs)) {
      future = fusion::climb_floor_chain(future, transposed(fits));
    }
  }
  return posterior;
}

/// The newest report of each climb, where its first one came.
std::vector<std::pair<std::size_t, VerticalMotion>> climbs_of(const std::vector<Event>& events) {
  std::vector<std::pair<std::size_t, VerticalMotion>> climbs;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const auto* climb = std::get_if<VerticalMotion>(&events[i]);
    if (climb == nullptr) continue;
    if (climbs.empty() || climbs.back().second.begin != climb->begin) {
      climbs.emplace_back(i, *climb);
    } else {
      climbs.back().second = *climb;
    }
  }
  return climbs;
}

std::vector<ChainLink> links_of(const std::vector<Event>& events, const std::vector<int>& levels,
                                const fusion::FloorFilter::Options& options) {
  const auto climbs = climbs_of(events);
  auto next = climbs.begin();
  std::vector<ChainLink> links;
  ChainLink link;
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (next != climbs.end() && next->first == i) {
      // Before the first scan a climb tells nothing: all floors are alike.
      if (!links.empty()) link.climbs.push_back(fusion::climb_fits(levels, next->second, options));
      ++next;
    }
    const auto* scan = std::get_if<RadioObservation>(&events[i]);
    if (scan == nullptr) continue;
    link.log_likelihoods =
        fusion::FloorFilter::weighted_log_likelihoods(*scan, levels.size(), options);
    links.push_back(std::exchange(link, {}));
  }
  return links;
}

}  // namespace

std::vector<FloorAt> smooth_floors(const std::vector<Event>& events,
                                   std::optional<core::FloorId> known_floor,
                                   const std::vector<int>& levels,
                                   const fusion::FloorFilter::Options& options) {
  std::vector<FloorAt> floors;
  for (const Event& event : events) {
    const auto* scan = std::get_if<RadioObservation>(&event);
    if (scan == nullptr) continue;
    floors.push_back({scan->delivered, known_floor.value_or(core::FloorId{}), 1.0});
  }
  if (known_floor || floors.empty()) return floors;
  const auto posterior =
      smooth_chain(links_of(events, levels, options), options.change_probability);
  for (std::size_t i = 0; i < floors.size(); ++i) {
    const auto best = std::ranges::max_element(posterior[i]);
    floors[i].floor = {static_cast<std::uint16_t>(best - posterior[i].begin())};
    floors[i].probability = *best;
  }
  return floors;
}

}  // namespace waylode::smoothing
