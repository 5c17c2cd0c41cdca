// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "waylode/core/id.hpp"
#include "waylode/core/result.hpp"
#include "waylode/core/time.hpp"
#include "waylode/observation/observation.hpp"

namespace waylode::fusion {

/// Which floor the person is on, by the votes of all scans so far: a hidden Markov chain that
/// rarely changes floor.
class FloorFilter {
 public:
  struct Options {
    double storey_m = 4.2;        ///< Usual height of a storey, m; 2.5 to 6.
    double storey_sigma_m = 1.0;  ///< How much storeys differ, m.
    /// Share of climbs that are not what they seem, (0, 1]: of those the floor stays likelier.
    double false_climb_ratio = 0.01;
    double change_probability = 0.002;  ///< Of leaving the floor between two scans.
    double vote_weight = 1.0;  ///< On each scan's log-likelihood; scans repeat each other's errors.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// Floors of the levels 0, 1, ...
  FloorFilter(const Options& options, std::size_t floor_count);
  /// By floor: the ordinal of its storey, as site::Floor::level.
  FloorFilter(const Options& options, std::vector<int> levels);

  /// Told from outside, to be doubted like a belief of its own: nine in ten for this floor.
  void start(core::FloorId floor);
  void add(const observation::RadioObservation& observation);
  /// A climb moves the belief from where it was before the first report of that climb. Before the
  /// first scan, and for a climb that is not finite, nothing is done.
  void add(const observation::VerticalMotion& motion);
  /// nullopt before the first scan or start.
  std::optional<core::FloorId> most_likely() const;
  /// Per floor; uniform before the first scan.
  const std::vector<double>& probabilities() const { return probabilities_; }

  /// The log-likelihoods of a scan for all floors, as the chain uses them.
  static std::vector<double> weighted_log_likelihoods(
      const observation::RadioObservation& observation, std::size_t floor_count,
      const Options& options);

 private:
  Options options_;
  std::vector<int> levels_;
  bool voted_ = false;
  std::vector<double> probabilities_;
  std::optional<core::DeviceTime> climb_begin_;  ///< Of the newest climb.
  std::vector<double> before_climb_;             ///< Probabilities at its first report.
};

/// Probabilities after one scan of the chain: floor may change, then the scan votes.
std::vector<double> advance_floor_chain(const std::vector<double>& probabilities,
                                        const std::vector<double>& log_likelihoods,
                                        double change_probability);

/// By floor from and floor to: how well a climb fits, 0 to 1 or a little more. Those who stay, and
/// climbs that lead off the floors given, fit as badly as a false climb. `levels` as in
/// FloorFilter.
std::vector<std::vector<double>> climb_fits(const std::vector<int>& levels,
                                            const observation::VerticalMotion& motion,
                                            const FloorFilter::Options& options);

/// Probabilities after a climb: of each floor, what the floors it may have begun on give it. A
/// climb that would lead off the floors given makes its start unlikely.
std::vector<double> climb_floor_chain(const std::vector<double>& probabilities,
                                      const std::vector<std::vector<double>>& fits);

}  // namespace waylode::fusion
