// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "waylode/core/fix.hpp"
#include "waylode/observation/observation.hpp"
#include "waylode/pipeline/session.hpp"

namespace waylode::pipeline {

/// The scan that was just heard, for estimators that match it again.
class HeardAgain {
 public:
  virtual ~HeardAgain() = default;
  /// Among the surveyed places near a belief, with how well they fit as the floor's
  /// log_likelihood; nullopt when none is near.
  virtual std::optional<observation::RadioObservation> near(const core::Belief& around) const = 0;
  /// The places of a floor that fit this scan and those of the seconds before it best, apart from
  /// each other; floor frame, the best first.
  virtual std::vector<core::Vector2> alternatives(core::FloorId floor, std::size_t count,
                                                  double apart_m) const = 0;
};

/// What a method does with steps and scans. The session feeds it; methods differ only here.
class Estimator {
 public:
  virtual ~Estimator() = default;
  virtual void add(const observation::MotionDelta& motion) = 0;
  /// A scan placed on the whole map.
  virtual void add(const observation::RadioObservation& observation, const HeardAgain& again) = 0;
  virtual void add(const observation::MagneticObservation& observation) = 0;
  /// For methods that count floors by climbs; others pass it over.
  virtual void add(const observation::VerticalMotion& /*motion*/) {}
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
