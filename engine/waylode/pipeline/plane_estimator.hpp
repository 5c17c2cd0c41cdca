// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "waylode/fusion/feedback_tracker.hpp"
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
  void add(const observation::RadioObservation& observation, const HeardAgain& again) final;
  void add(const observation::MagneticObservation& observation) final;
  void hear_unknown(core::DeviceTime delivered) final;
  std::optional<core::Belief> belief_at(core::DeviceTime time) const final;
  core::FixState state_at(core::DeviceTime time, const core::Belief& belief) const final;

 protected:
  /// HeardAgain in the site frame, on the floor the person is thought to be on.
  class Again {
   public:
    Again(const site::Site& site, core::FloorId floor, const HeardAgain& again)
        : site_(site), floor_(floor), again_(again) {}
    std::optional<fusion::CircleMatch> near(const core::Vector2& place_m) const;
    std::vector<core::Vector2> alternatives(std::size_t count, double apart_m) const;

   private:
    const site::Site& site_;
    core::FloorId floor_;
    const HeardAgain& again_;
  };

  PlaneEstimator(const Model& model, const SessionOptions& options);

  /// Told before everything else when the session has a start.
  virtual void start(const fusion::PlanarEstimate& place) = 0;
  virtual void step(const observation::MotionDelta& motion) = 0;
  virtual void hear(const fusion::PlanarMeasurement& whole_map, const Again& again) = 0;
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
