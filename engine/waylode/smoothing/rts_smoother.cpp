// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/smoothing/rts_smoother.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <iterator>

namespace waylode::smoothing {

std::vector<fusion::PlanarState> smooth_backward(
    const std::deque<fusion::PlanarTransition>& history, const fusion::PlanarState& last) {
  std::vector<fusion::PlanarState> nodes(history.size() + 1);
  nodes.back() = last;
  for (std::size_t i = history.size(); i-- > 0;) {
    const fusion::PlanarTransition& step = history[i];
    const fusion::PlanarState& next = nodes[i + 1];
    const fusion::PlanarMatrix gain = step.predicted.covariance.ldlt()
                                          .solve(step.transition * step.filtered.covariance)
                                          .transpose();
    nodes[i].time = step.filtered.time;
    nodes[i].mean = step.filtered.mean + gain * (next.mean - step.predicted.mean);
    const fusion::PlanarMatrix covariance =
        step.filtered.covariance +
        gain * (next.covariance - step.predicted.covariance) * gain.transpose();
    nodes[i].covariance = 0.5 * (covariance + covariance.transpose());
  }
  return nodes;
}

fusion::PlanarState interpolate(const std::vector<fusion::PlanarState>& nodes,
                                core::DeviceTime time) {
  const auto after = std::ranges::lower_bound(nodes, time, {}, &fusion::PlanarState::time);
  if (after == nodes.end()) return nodes.back();
  if (after == nodes.begin()) return nodes.front();
  const auto before = std::prev(after);
  const double share =
      core::to_seconds(time - before->time) / core::to_seconds(after->time - before->time);
  fusion::PlanarState result = share < 0.5 ? *before : *after;
  result.time = time;
  result.mean = (1.0 - share) * before->mean + share * after->mean;
  return result;
}

}  // namespace waylode::smoothing
