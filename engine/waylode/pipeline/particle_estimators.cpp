// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pipeline/particle_estimators.hpp"

#include "waylode/core/assert.hpp"

namespace waylode::pipeline {
namespace {

using observation::MotionDelta;
using observation::RadioObservation;

/// What all three have in common: they differ in the tracker alone.
template <typename Tracker>
class ParticleMethod : public Estimator {
 public:
  template <typename... Arguments>
  explicit ParticleMethod(Arguments&&... arguments)
      : tracker_(std::forward<Arguments>(arguments)...) {}

  void add(const MotionDelta& motion) override { tracker_.add(motion); }
  void add(const RadioObservation& observation, const HeardAgain& /*again*/) override {
    tracker_.add(observation);
  }
  void add(const observation::MagneticObservation& /*observation*/) override {}
  void add(const observation::VerticalMotion& motion) override { tracker_.add(motion); }
  void hear_unknown(core::DeviceTime delivered) override { tracker_.hear_unknown(delivered); }
  std::optional<core::Belief> belief_at(core::DeviceTime time) const override {
    return tracker_.belief_at(time);
  }
  core::FixState state_at(core::DeviceTime time, const core::Belief& belief) const override {
    return tracker_.state_at(time, belief);
  }

  Tracker& tracker() { return tracker_; }

 private:
  Tracker tracker_;
};

}  // namespace

std::unique_ptr<Estimator> make_particle_estimator(const Model& model, const Method& method,
                                                   const SessionOptions& options) {
  const Options& tunables = model.options();
  fusion::Terrain terrain = model.terrain();
  if (method.recipe.magnetic == MagneticPart::kNone) terrain.fields = nullptr;
  switch (method.recipe.fusion) {
    case FusionPart::kFixedLag:
      return std::make_unique<ParticleMethod<smoothing::FixedLagParticles>>(
          model.site(), terrain, tunables.tracker_options(), options.known_floor, method.lag);
    case FusionPart::kWholeTrack:
      return std::make_unique<ParticleMethod<smoothing::ParticleSmoother>>(
          model.site(), terrain, tunables.particle_smoothing_options(), options.known_floor);
    default:
      break;
  }
  WAYLODE_ASSERT(method.recipe.fusion == FusionPart::kParticles);
  auto causal = std::make_unique<ParticleMethod<fusion::ParticleTracker>>(
      model.site(), terrain, tunables.tracker_options(), options.known_floor);
  if (options.start) {
    causal->tracker().start(options.start->time, options.start->floor, options.start->position_m,
                            options.start->sigma_m);
  }
  return causal;
}

}  // namespace waylode::pipeline
