// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pipeline/field_matching.hpp"

#include <cmath>

#include "waylode/core/angle.hpp"
#include "waylode/magnetic/features.hpp"

namespace waylode::pipeline {

std::optional<observation::MagneticObservation> FieldMatching::add(
    const sample::Sample& sample, const std::optional<observation::MotionDelta>& motion,
    const std::optional<core::Vector3>& up_in_device, const Estimator& estimator) {
  const auto* field = std::get_if<sample::MagnetometerSample>(&sample);
  if (field != nullptr && up_in_device) {
    if (const auto level = magnetic::level_field(field->field_ut, *up_in_device)) {
      matcher_.add(field->time, *level);
    }
  }
  if (!motion) return std::nullopt;
  matcher_.add(*motion);
  if (last_asked_ && core::to_seconds(motion->end - *last_asked_) < options_.interval_s) {
    return std::nullopt;
  }
  const std::optional<core::Belief> belief = estimator.belief_at(motion->end);
  if (!belief) return std::nullopt;
  last_asked_ = motion->end;
  const magnetic::SequenceMatcher::Prior prior{*belief, heading_offset_rad(belief->floor), 1.0};
  return matcher_.match(motion->end, prior, (*fields_)[belief->floor.index]);
}

double FieldMatching::heading_offset_rad(core::FloorId floor) const {
  const site::Floor& here = site_->floor(floor);
  const core::Matrix2& turn = here.site_from_floor.linear;
  return core::wrap_angle(here.heading_offset_rad - std::atan2(turn(1, 0), turn(0, 0)));
}

}  // namespace waylode::pipeline
