// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "waylode/core/result.hpp"
#include "waylode/fusion/decision_flow.hpp"
#include "waylode/fusion/feedback_tracker.hpp"
#include "waylode/fusion/fused_tracker.hpp"
#include "waylode/fusion/particle_tracker.hpp"
#include "waylode/fusion/zhou_tracker.hpp"
#include "waylode/magnetic/field_grid.hpp"
#include "waylode/magnetic/field_likelihood.hpp"
#include "waylode/magnetic/sequence_matcher.hpp"
#include "waylode/pdr/dead_reckoning.hpp"
#include "waylode/pdr/pressure_climb.hpp"
#include "waylode/radio/circle_knn.hpp"
#include "waylode/radio/device_response.hpp"
#include "waylode/radio/knn_positioner.hpp"
#include "waylode/radio/matcher.hpp"
#include "waylode/radio/place_likelihood.hpp"
#include "waylode/radio/reference_map.hpp"
#include "waylode/radio/region_wknn.hpp"
#include "waylode/radio/regression_positioner.hpp"
#include "waylode/radio/scan_assembler.hpp"
#include "waylode/radio/window_knn.hpp"
#include "waylode/radio/wknn.hpp"
#include "waylode/site/walkability.hpp"
#include "waylode/smoothing/particle_smoother.hpp"
#include "waylode/smoothing/smoothed_tracker.hpp"
#include "waylode/survey/map_builder.hpp"

namespace waylode::pipeline {

/// Every tunable of the engine. Defaults live in the components; one set serves all buildings.
struct Options {
  /// When the field is matched, and how.
  struct FieldMatch {
    double interval_s = 0.5;  ///< Between two matches; each costs a fraction of a millisecond.
    magnetic::FieldGrid::Options grid;
    magnetic::SequenceMatcher::Options sequence;
    magnetic::FieldLikelihood::Options guesses;  ///< For trackers by particles.

    bool operator==(const FieldMatch&) const = default;
  };

  radio::ScanAssembler::Options scan;
  radio::Matcher::Options matcher;
  radio::WknnEstimator::Options wknn;
  radio::PlaceLikelihood::Options places;  ///< For trackers by particles.
  radio::DeviceResponse::Options response;
  double bluetooth_alone_after_s = 3.5;  ///< Without Wi-Fi this long, Bluetooth is matched alone.
  radio::ReferenceMap::Options references;  ///< For the papers' ways of placing scans.
  radio::KnnPositioner::Options knn;
  radio::RegionWknn::Options region;
  radio::WindowKnn::Options window;
  radio::CircleKnn::Options circle;
  radio::RegressionPositioner::Options regression;  ///< Its kind is the method's choice.
  pdr::DeadReckoning::Options pdr;
  pdr::PressureClimb::Options pressure;
  FieldMatch field;
  fusion::DecisionFlow::Options decision;
  fusion::ZhouTracker::Options interval;
  fusion::FeedbackTracker::Options feedback = several_starts();
  fusion::FusedTracker::Options fused;
  fusion::ParticleFilter::Options particles;
  std::size_t smoothing_particles = 4000;
  double smoothing_horizon_s = 60.0;
  site::Walkability::Options walkability;
  int smoothing_rounds = smoothing::TrackSmoother::Options{}.rounds;
  survey::LabelledPath::Options labels;
  survey::MovingTransmitterFilter::Options moving;
  survey::MovingTransmitterFilter::Evidence moving_evidence =
      survey::MovingTransmitterFilter::Evidence::kLoudPlaces;
  survey::MagneticSurvey::Options magnetic_survey;

  /// Feedback as a filter from several starts: the paper's own never finds out of a wrong one.
  static fusion::FeedbackTracker::Options several_starts();
  survey::MapBuilder::Options survey_options() const {
    return {scan, pdr, labels, moving, moving_evidence, magnetic_survey};
  }
  fusion::ParticleTracker::Options tracker_options() const {
    return {particles, fused.floor, fused.state};
  }
  smoothing::ParticleSmoother::Options particle_smoothing_options() const {
    return {tracker_options(), smoothing_particles, smoothing_horizon_s};
  }
  smoothing::TrackSmoother::Options smoothing_options() const { return {fused, smoothing_rounds}; }
  core::Result<void> validate() const;
  bool operator==(const Options&) const = default;
};

}  // namespace waylode::pipeline
