// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/result.hpp"
#include "waylode/core/time.hpp"
#include "waylode/experiment/bootstrap.hpp"
#include "waylode/experiment/outcome.hpp"
#include "waylode/magnetic/field_grid.hpp"
#include "waylode/magnetic/sequence_matcher.hpp"
#include "waylode/site/magnetic_map.hpp"
#include "waylode/survey/magnetic_survey.hpp"

namespace waylode::experiment {

/// A walk along straight stretches with the field on the way.
struct FieldWalk {
  struct Reading {
    core::DeviceTime time;
    core::Vector3 field_ut = core::Vector3::Zero();  ///< Device frame.
    core::Vector3 up_in_device = core::Vector3::UnitZ();
    double heading_rad = 0.0;  ///< By the phone's compass, counter-clockwise from +x.

    bool operator==(const Reading&) const = default;
  };
  /// Walked evenly from the first to the last of its readings.
  struct Stretch {
    core::Vector2 from_m = core::Vector2::Zero();
    core::Vector2 to_m = core::Vector2::Zero();
    std::size_t first = 0;
    std::size_t last = 0;  ///< More than `first`.

    bool operator==(const Stretch&) const = default;
  };

  std::string name;
  std::vector<Reading> readings;   ///< By time.
  std::vector<Stretch> stretches;  ///< In order, without overlap, within the readings.

  /// nullopt between stretches.
  std::optional<core::Vector2> truth_m(std::size_t reading) const;
};

struct MagneticMatchingOptions {
  magnetic::SequenceMatcher::Options matcher;
  magnetic::FieldGrid::Options grid;
  double speed_mps = 0.85;  ///< Walks tell no steps: everybody is taken to walk this fast.
  /// Where the search starts is off the truth by this, per axis, drawn anew at each match.
  double start_sigma_m = 2.0;
  bool global = false;   ///< The start is the middle of the map instead; the search covers it all.
  bool chained = false;  ///< The start is the last match, walked on; the first as above.
  std::uint64_t seed = 1;
};

struct MagneticMatching {
  std::size_t tried = 0;       ///< Once a second, from when a whole window could have been walked.
  std::vector<Unit> errors_m;  ///< Per walk, of the matches that said something.
  std::vector<double> squared_mahalanobis;  ///< Of the same errors: mean 2 when honest.
};

/// Length over time of all stretches together; 0 without any.
double mean_speed_mps(const std::vector<FieldWalk>& walks);

/// The map of walks whose truth is known, as the survey makes it.
site::MagneticMapStorage map_of(const std::vector<FieldWalk>& walks,
                                const survey::MagneticSurvey::Options& options);

/// Replays walks causally against a map made of others. The path's shape is the compass at an even
/// speed. `options` must be valid.
MagneticMatching match_walks(const std::vector<FieldWalk>& walks, const site::MagneticMap& map,
                             const MagneticMatchingOptions& options);

/// The paper's question on real walks: a map of the training walks, matched along the tests with
/// windows of 2 s (literal), 6 s and 10 s around a start known to 2 m per axis.
core::Result<Outcome> magnetic_matching_outcome(const std::vector<FieldWalk>& training,
                                                const std::vector<FieldWalk>& tests);

}  // namespace waylode::experiment
