// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "waylode/core/result.hpp"
#include "waylode/fusion/fused_tracker.hpp"
#include "waylode/pdr/dead_reckoning.hpp"
#include "waylode/radio/matcher.hpp"
#include "waylode/radio/scan_assembler.hpp"
#include "waylode/radio/wknn.hpp"
#include "waylode/smoothing/smoothed_tracker.hpp"
#include "waylode/survey/map_builder.hpp"

namespace waylode::pipeline {

/// Every tunable of the engine. Defaults live in the components; one set serves all buildings.
struct Options {
  radio::ScanAssembler::Options scan;
  radio::Matcher::Options matcher;
  radio::WknnEstimator::Options wknn;
  double bluetooth_alone_after_s = 3.5;  ///< Without Wi-Fi this long, Bluetooth is matched alone.
  pdr::DeadReckoning::Options pdr;
  fusion::FusedTracker::Options fused;
  int smoothing_rounds = smoothing::TrackSmoother::Options{}.rounds;
  survey::LabelledPath::Options labels;
  survey::MovingTransmitterFilter::Options moving;

  survey::MapBuilder::Options survey_options() const { return {scan, pdr, labels, moving}; }
  smoothing::TrackSmoother::Options smoothing_options() const { return {fused, smoothing_rounds}; }
  core::Result<void> validate() const;
  bool operator==(const Options&) const = default;
};

}  // namespace waylode::pipeline
