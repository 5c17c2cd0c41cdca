// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "waylode/core/id.hpp"
#include "waylode/core/result.hpp"
#include "waylode/observation/observation.hpp"

namespace waylode::fusion {

/// Which floor the person is on, by the votes of all scans so far: a hidden Markov chain that
/// rarely changes floor.
class FloorFilter {
 public:
  struct Options {
    double change_probability = 0.002;  ///< Of leaving the floor between two scans.
    double vote_weight = 1.0;  ///< On each scan's log-likelihood; scans repeat each other's errors.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  FloorFilter(const Options& options, std::size_t floor_count);

  void add(const observation::RadioObservation& observation);
  /// nullopt before the first scan.
  std::optional<core::FloorId> most_likely() const;
  /// Per floor; uniform before the first scan.
  const std::vector<double>& probabilities() const { return probabilities_; }

  /// The log-likelihoods of a scan for all floors, as the chain uses them.
  static std::vector<double> weighted_log_likelihoods(
      const observation::RadioObservation& observation, std::size_t floor_count,
      const Options& options);

 private:
  Options options_;
  bool voted_ = false;
  std::vector<double> probabilities_;
};

/// Probabilities after one scan of the chain: floor may change, then the scan votes.
std::vector<double> advance_floor_chain(const std::vector<double>& probabilities,
                                        const std::vector<double>& log_likelihoods,
                                        double change_probability);

}  // namespace waylode::fusion
