// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/smoothing/rts_smoother.hpp"

#include <Eigen/Cholesky>

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

}  // namespace waylode::smoothing
