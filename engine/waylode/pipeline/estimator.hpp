// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "waylode/core/fix.hpp"
#include "waylode/observation/observation.hpp"
#include "waylode/pipeline/session.hpp"

namespace waylode::pipeline {

/// Matches the scan that was just heard once more, among the surveyed places near a belief; nullopt
/// when none is near.
using NearMatch = std::function<std::optional<observation::RadioObservation>(const core::Belief&)>;

/// What a method does with steps and scans. The session feeds it; methods differ only here.
class Estimator {
 public:
  virtual ~Estimator() = default;
  virtual void add(const observation::MotionDelta& motion) = 0;
  /// A scan placed on the whole map.
  virtual void add(const observation::RadioObservation& observation, const NearMatch& near) = 0;
  virtual void add(const observation::MagneticObservation& observation) = 0;
  /// A scan of which the map knows nothing: tells no place, but that the phone is off the map. The
  /// state is `outside` until a known scan comes; the belief stays.
  virtual void hear_unknown(core::DeviceTime delivered) = 0;
  virtual std::optional<core::Belief> belief_at(core::DeviceTime time) const = 0;
  /// What a belief of belief_at(time) deserves.
  virtual core::FixState state_at(core::DeviceTime time, const core::Belief& belief) const = 0;
};

/// `method` is registered and `options` suit it.
std::unique_ptr<Estimator> make_estimator(const Model& model, const Method& method,
                                          const SessionOptions& options);

}  // namespace waylode::pipeline
