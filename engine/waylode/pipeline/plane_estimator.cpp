// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pipeline/plane_estimator.hpp"

#include <algorithm>

namespace waylode::pipeline {
namespace {

core::Belief to_floor(const site::Site& site, core::FloorId floor, double probability,
                      const fusion::PlanarEstimate& place) {
  const core::Affine2 floor_from_site = site.floor(floor).site_from_floor.inverse();
  return {floor, probability, floor_from_site * place.position_m,
          floor_from_site.map_covariance(place.covariance_m2)};
}

}  // namespace

PlaneEstimator::PlaneEstimator(const Model& model, const SessionOptions& options)
    : model_(&model),
      options_(options),
      floor_filter_(model.options().fused.floor, model.site()->floors().size()) {}

void PlaneEstimator::begin() {
  if (!options_.start) return;
  options_.known_floor = options_.start->floor;
  const double variance_m2 = options_.start->sigma_m * options_.start->sigma_m;
  start({options_.start->time,
         model_->site()->site_from_floor(options_.start->floor, options_.start->position_m),
         variance_m2 * core::Matrix2::Identity()});
}

void PlaneEstimator::add(const observation::MotionDelta& motion) {
  if (!floor()) return;
  if (options_.start && motion.end <= options_.start->time) return;
  step(fusion::on_site_frame(motion, model_->site()->floor(*floor())));
}

void PlaneEstimator::add(const observation::RadioObservation& observation,
                         const HeardAgain& again) {
  floor_filter_.add(observation);
  newest_scan_ = fusion::HeardScan{observation.delivered, observation.known_share_ratio};
  const core::FloorId here = *floor();
  const site::Site& site = *model_->site();
  const auto* hypothesis = fusion::find_hypothesis(observation, here);
  if (hypothesis == nullptr) return;
  hear(fusion::to_site_frame(site, observation, *hypothesis), Again(site, here, again));
}

std::optional<fusion::CircleMatch> PlaneEstimator::Again::near(const core::Vector2& place_m) const {
  const auto matched = again_.near(to_floor(site_, floor_, 1.0, {core::DeviceTime(), place_m}));
  if (!matched) return std::nullopt;
  const auto* found = fusion::find_hypothesis(*matched, floor_);
  if (found == nullptr) return std::nullopt;
  return fusion::CircleMatch{fusion::to_site_frame(site_, *matched, *found), found->log_likelihood};
}

std::vector<core::Vector2> PlaneEstimator::Again::alternatives(std::size_t count,
                                                               double apart_m) const {
  std::vector<core::Vector2> places = again_.alternatives(floor_, count, apart_m);
  for (core::Vector2& place_m : places) place_m = site_.site_from_floor(floor_, place_m);
  return places;
}

void PlaneEstimator::add(const observation::MagneticObservation& observation) {
  if (floor() != observation.floor) return;
  const site::Site& site = *model_->site();
  feel({observation.time, site.site_from_floor(observation.floor, observation.position_m),
        site.floor(observation.floor).site_from_floor.map_covariance(observation.covariance_m2)});
}

void PlaneEstimator::hear_unknown(core::DeviceTime delivered) {
  newest_scan_ = fusion::HeardScan{delivered, 0.0};
}

std::optional<core::Belief> PlaneEstimator::belief_at(core::DeviceTime time) const {
  const auto here = floor();
  const auto place = place_at(time);
  if (!here || !place) return std::nullopt;
  const double probability =
      options_.known_floor ? 1.0 : floor_filter_.probabilities()[here->index];
  return to_floor(*model_->site(), *here, probability, *place);
}

core::FixState PlaneEstimator::state_at(core::DeviceTime time, const core::Belief& belief) const {
  return fusion::state_of(belief, time, newest_scan_, model_->options().fused.state);
}

std::optional<core::FloorId> PlaneEstimator::floor() const {
  return options_.known_floor ? options_.known_floor : floor_filter_.most_likely();
}

}  // namespace waylode::pipeline
