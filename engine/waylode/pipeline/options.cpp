// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pipeline/options.hpp"

namespace waylode::pipeline {

fusion::FeedbackTracker::Options Options::several_starts() {
  fusion::FeedbackTracker::Options feedback;
  feedback.reading = fusion::FeedbackReading::kFiltered;
  feedback.hypotheses = 6;
  return feedback;
}

core::Result<void> Options::validate() const {
  for (const core::Result<void>& part : {scan.validate(),
                                         matcher.validate(),
                                         wknn.validate(),
                                         references.validate(),
                                         knn.validate(),
                                         region.validate(),
                                         window.validate(),
                                         circle.validate(),
                                         regression.validate(),
                                         field.grid.validate(),
                                         field.sequence.validate(),
                                         field.guesses.validate(),
                                         decision.validate(),
                                         pressure.validate(),
                                         interval.validate(),
                                         feedback.validate(),
                                         survey_options().validate(),
                                         smoothing_options().validate(),
                                         places.validate(),
                                         response.validate(),
                                         walkability.validate(),
                                         particle_smoothing_options().validate()}) {
    if (!part) return part;
  }
  if (!(field.interval_s >= 0.0)) {
    return core::fail(core::ErrorCode::kInvalidOptions, "interval_s must not be negative", "field");
  }
  if (!(bluetooth_alone_after_s > 0.0)) {
    return core::fail(core::ErrorCode::kInvalidOptions, "bluetooth_alone_after_s must be positive",
                      "pipeline");
  }
  return {};
}

}  // namespace waylode::pipeline
