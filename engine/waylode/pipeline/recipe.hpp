// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "waylode/core/result.hpp"
#include "waylode/pdr/dead_reckoning.hpp"

namespace waylode::pipeline {

/// How a scan becomes a place.
enum class RadioPart : std::uint8_t {
  kNone,
  kWknn,
  kKnn,
  kRegionWknn,
  kWindowKnn,
  kRelevanceVectors,
  kSupportVectors,
};

/// How the magnetic field becomes a place.
enum class MagneticPart : std::uint8_t { kNone, kSequence, kGuesses };

/// What becomes of steps and places.
enum class FusionPart : std::uint8_t {
  kNewestScan,
  kDeadReckoning,
  kParticles,
  kFixedLag,
  kWholeTrack,
  kRobust,
  kRobustWhole,
  kUnscented,
  kUnscentedWhenLarge,
  kPairs,
  kMagnetic,
  kIntervals,
  kIntervalsUnfiltered,
  kRawTerms,
  kFeedback,
  kFeedbackLiteral,
};

/// A pipeline as a choice of one part for each slot. A paper is a recipe, and so is any mixture.
struct Recipe {
  pdr::DeadReckoning::Detector steps = pdr::DeadReckoning::Detector::kThreshold;
  pdr::DeadReckoning::Validity validity = pdr::DeadReckoning::Validity::kOff;
  pdr::StrideModel::Model stride = pdr::StrideModel::Model::kThreeTerm;
  bool learns_stride = false;  ///< Its gains are corrected on line; for kImproved.
  pdr::DeadReckoning::HeadingSource heading = pdr::DeadReckoning::HeadingSource::kRotationVector;
  RadioPart radio = RadioPart::kWknn;
  MagneticPart magnetic = MagneticPart::kNone;
  FusionPart fusion = FusionPart::kParticles;

  /// Whether scans are weighed place by place.
  bool weighs_places() const {
    return fusion == FusionPart::kParticles || fusion == FusionPart::kFixedLag ||
           fusion == FusionPart::kWholeTrack;
  }
  bool operator==(const Recipe&) const = default;
};

/// One way to fill a slot.
struct Part {
  std::string_view
      slot;  ///< "steps", "validity", "stride", "heading", "radio", "magnetic", "fusion".
  std::string_view name;
  std::string_view summary;
  std::string_view source;  ///< A key of docs/references.bib, or "own".
  void (*choose)(Recipe&) = nullptr;
};

/// Every part, slot by slot in the order of the data.
std::span<const Part> parts();

/// Fills the slot as "slot=part" says. kMethodUnknown names the known slots or parts.
core::Result<void> choose_part(Recipe& recipe, std::string_view assignment);

/// The name of the part that fills a slot; the slot is one of parts().
std::string_view part_name(const Recipe& recipe, std::string_view slot);

}  // namespace waylode::pipeline
