// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "waylode/core/fix.hpp"
#include "waylode/core/geometry.hpp"
#include "waylode/core/id.hpp"
#include "waylode/core/time.hpp"
#include "waylode/site/site.hpp"

namespace waylode::eval {

/// Where the person was, as surveyed.
struct TruthPoint {
  core::DeviceTime time;
  core::FloorId floor;
  core::Vector2 position_m = core::Vector2::Zero();  ///< Floor frame.
  /// False for instants before the first usable scan of a causal method: counted, not judged.
  bool scored = true;
};

/// One method on one recording: what it said at each truth's instant.
struct EvaluatedTrack {
  std::string name;   ///< The recording's.
  std::string group;  ///< "<site>/<floor>", as the data set names them.
  std::string method;
  bool covered = false;  ///< Runs along surveyed paths; see docs/benchmarks.md for the rule.
  std::shared_ptr<const site::Site> site;
  std::vector<TruthPoint> truths;
  std::vector<core::Fix> fixes;  ///< Parallel to `truths`.
  /// Every whole second from the first truth to the last, where asked for; not judged.
  std::vector<core::Fix> path{};
  double walked_s = 0.0;  ///< From the first to the last truth.
  double cpu_s = 0.0;     ///< Spent by the method.
};

}  // namespace waylode::eval
