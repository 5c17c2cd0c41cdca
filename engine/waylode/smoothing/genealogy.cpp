// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/smoothing/genealogy.hpp"

#include <algorithm>
#include <numeric>

namespace waylode::smoothing {
namespace {

using fusion::ParticleFilter;
using fusion::PlanarEstimate;

/// The guesses of a later node, followed back.
class Descent {
 public:
  explicit Descent(const ParticleFilter::Node& end)
      : weights_(end.weights), ancestors_(end.places_m.size()) {
    std::iota(ancestors_.begin(), ancestors_.end(), 0U);
  }

  /// One node back; false when nobody goes further.
  bool go_back(const ParticleFilter::Node& node) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < ancestors_.size(); ++i) {
      const std::uint32_t parent = node.parents[ancestors_[i]];
      if (parent == ParticleFilter::kNoParent || !(weights_[i] > 0.0F)) continue;
      ancestors_[kept] = parent;
      weights_[kept] = weights_[i];
      ++kept;
    }
    ancestors_.resize(kept);
    weights_.resize(kept);
    return kept > 0;
  }

  PlanarEstimate estimate(const ParticleFilter::Node& node, double base_sigma_m,
                          double sigma_scale) const {
    std::vector<core::Vector2> places_m;
    std::vector<double> weights;
    core::Vector2 mean_m = core::Vector2::Zero();
    double total = 0.0;
    for (std::size_t i = 0; i < ancestors_.size(); ++i) {
      places_m.emplace_back(node.places_m[ancestors_[i]].cast<double>());
      weights.push_back(static_cast<double>(weights_[i]));
      mean_m += weights.back() * places_m.back();
      total += weights.back();
    }
    PlanarEstimate estimate{node.time, fusion::spatial_median(places_m, weights, mean_m / total),
                            core::Matrix2::Zero()};
    for (std::size_t i = 0; i < places_m.size(); ++i) {
      const core::Vector2 off_m = places_m[i] - estimate.position_m;
      estimate.covariance_m2 += weights[i] / total * off_m * off_m.transpose();
    }
    estimate.covariance_m2 = sigma_scale * sigma_scale * estimate.covariance_m2 +
                             base_sigma_m * base_sigma_m * core::Matrix2::Identity();
    return estimate;
  }

 private:
  std::vector<float> weights_;
  std::vector<std::uint32_t> ancestors_;
};

/// The node whose guesses tell of `node`: the first that knows half the horizon more, or the last
/// within the horizon where there is none.
std::size_t teller_of(const std::deque<ParticleFilter::Node>& history, std::size_t node,
                      core::Duration horizon) {
  std::size_t teller = node;
  while (teller + 1 < history.size() && history[teller].time - history[node].time < horizon / 2 &&
         history[teller + 1].time - history[node].time <= horizon) {
    ++teller;
  }
  return teller;
}

}  // namespace

std::vector<PlanarEstimate> trace_back(const std::deque<ParticleFilter::Node>& history,
                                       core::Duration horizon, double base_sigma_m,
                                       double sigma_scale) {
  std::vector<PlanarEstimate> estimates(history.size());
  std::size_t open = history.size();   // Nodes before it have none yet.
  std::size_t limit = history.size();  // Descents of nodes from here on do not reach further.
  while (open > 0) {
    const std::size_t from = std::min(limit - 1, teller_of(history, open - 1, horizon));
    const std::size_t first_open = open;
    Descent descent(history[from]);
    for (std::size_t node = from;; --node) {
      if (node < open) {
        estimates[node] = descent.estimate(history[node], base_sigma_m, sigma_scale);
        open = node;
      }
      if (node == 0 || history[from].time - history[node - 1].time > horizon) break;
      if (!descent.go_back(history[node])) break;
    }
    // Where all descent ended, a nearer future may reach further, the node itself at worst.
    limit = open < first_open ? history.size() : open + (from - open + 1) / 2;
  }
  return estimates;
}

}  // namespace waylode::smoothing
