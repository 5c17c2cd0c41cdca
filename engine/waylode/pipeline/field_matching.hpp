// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/magnetic/field_grid.hpp"
#include "waylode/magnetic/sequence_matcher.hpp"
#include "waylode/observation/observation.hpp"
#include "waylode/pipeline/estimator.hpp"
#include "waylode/sample/sample.hpp"
#include "waylode/site/site.hpp"

namespace waylode::pipeline {

/// Feeds one phone's field and steps to the sequence matcher and asks it now and then, around where
/// the estimator thinks the phone is.
class FieldMatching {
 public:
  /// `fields` per floor of `site`.
  FieldMatching(std::shared_ptr<const site::Site> site,
                std::shared_ptr<const std::vector<magnetic::FieldGrid>> fields,
                const Options::FieldMatch& options)
      : site_(std::move(site)),
        fields_(std::move(fields)),
        options_(options),
        matcher_(options.sequence) {}

  /// A sample, and the step it completed. Returns a place when one was asked for and found.
  std::optional<observation::MagneticObservation> add(
      const sample::Sample& sample, const std::optional<observation::MotionDelta>& motion,
      const std::optional<core::Vector3>& up_in_device, const Estimator& estimator);

 private:
  /// PDR heading plus this is the heading on the floor's own axes.
  double heading_offset_rad(core::FloorId floor) const;

  std::shared_ptr<const site::Site> site_;
  std::shared_ptr<const std::vector<magnetic::FieldGrid>> fields_;
  Options::FieldMatch options_;
  magnetic::SequenceMatcher matcher_;
  std::optional<core::DeviceTime> last_asked_;
};

}  // namespace waylode::pipeline
