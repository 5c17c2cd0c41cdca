// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "waylode/fusion/floor_filter.hpp"
#include "waylode/fusion/fused_tracker.hpp"
#include "waylode/fusion/planar_estimate.hpp"
#include "waylode/pipeline/estimator.hpp"

namespace waylode::pipeline {

/// A method that thinks in one plane. This part sees to the rest: floors by vote, frames, states.
/// What derives from it hears steps and positions in the site frame and answers there.
class PlaneEstimator : public Estimator {
 public:
  void add(const observation::MotionDelta& motion) final;
  void add(const observation::RadioObservation& observation, const NearMatch& near) final;
  void add(const observation::MagneticObservation& observation) final;
  void hear_unknown(core::DeviceTime delivered) final;
  std::optional<core::Belief> belief_at(core::DeviceTime time) const final;
  core::FixState state_at(core::DeviceTime time, const core::Belief& belief) const final;

 protected:
  /// The scan just heard, matched among the surveyed places near a place of the site frame.
  using NearPlace = std::function<std::optional<fusion::PlanarMeasurement>(const core::Vector2&)>;

  PlaneEstimator(const Model& model, const SessionOptions& options);

  /// Told before everything else when the session has a start.
  virtual void start(const fusion::PlanarEstimate& place) = 0;
  virtual void step(const observation::MotionDelta& motion) = 0;
  virtual void hear(const fusion::PlanarMeasurement& whole_map, const NearPlace& near) = 0;
  /// Most methods have no use for the field.
  virtual void feel(const fusion::PlanarEstimate& /*place*/) {}
  /// nullopt before anything is known.
  virtual std::optional<fusion::PlanarEstimate> place_at(core::DeviceTime time) const = 0;

  /// To be called by what derives, at the end of its construction.
  void begin();

 private:
  std::optional<core::FloorId> floor() const;

  const Model* model_;
  SessionOptions options_;
  fusion::FloorFilter floor_filter_;
  std::optional<fusion::HeardScan> newest_scan_;
};

}  // namespace waylode::pipeline
