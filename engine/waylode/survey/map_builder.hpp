// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "waylode/core/result.hpp"
#include "waylode/pdr/dead_reckoning.hpp"
#include "waylode/radio/scan_assembler.hpp"
#include "waylode/sample/sample.hpp"
#include "waylode/site/site.hpp"
#include "waylode/survey/labelled_path.hpp"
#include "waylode/survey/magnetic_survey.hpp"
#include "waylode/survey/moving_transmitters.hpp"
#include "waylode/survey/surveyed_recording.hpp"

namespace waylode::survey {

/// What a build found on one floor.
struct FloorQuality {
  std::string floor;
  std::uint64_t recordings = 0;
  std::uint64_t fingerprints = 0;
  std::uint64_t transmitters = 0;
  double median_transmitters_per_fingerprint = 0.0;
  double surveyed_m = 0.0;  ///< Length of the labelled walks.
  /// Share of the walkable area (of the survey's box, without a plan) within 3 m of a fingerprint.
  double covered_ratio = 0.0;
  double heading_offset_rad = 0.0;  ///< Learnt; see site::Floor.
  double step_scale = 1.0;          ///< Marked over reckoned distance, median.
};

struct QualityReport {
  std::vector<FloorQuality> floors;
  std::uint64_t stretches = 0;           ///< Between two marks.
  std::uint64_t stretches_straight = 0;  ///< Labelled along a line: steps did not fit.
  std::uint64_t stretches_rejected = 0;  ///< Gave no labels.
  std::uint64_t scans_unlabelled = 0;    ///< Heard outside the marks or on rejected stretches.
  /// Told already: by an earlier recording, or by an earlier scan of the same time.
  std::uint64_t readings_duplicate = 0;
  std::uint64_t readings_unmappable = 0;  ///< Transmitter asks not to be mapped.
  std::uint64_t transmitters_moving = 0;  ///< Left out: they move.
  std::vector<std::string> notes;         ///< Recordings that gave nothing, and why.
};

struct SurveyedSite {
  site::SiteParts parts;
  QualityReport quality;
};

/// Surveyed walks in, radio map and magnetic map out. Scans become instances at the places where
/// their signals were heard; floors learn how far the phone's compass is off their plan.
class MapBuilder {
 public:
  struct Options {
    radio::ScanAssembler::Options scan;
    pdr::DeadReckoning::Options pdr;
    LabelledPath::Options labels;
    MovingTransmitterFilter::Options moving;
    /// kAll for surveys of several walks through every place, some days apart.
    MovingTransmitterFilter::Evidence moving_evidence =
        MovingTransmitterFilter::Evidence::kLoudPlaces;
    MagneticSurvey::Options magnetic{};

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// `parts`: floors and frames; their maps are ignored. `options` must be valid.
  MapBuilder(site::SiteParts parts, const Options& options);

  void add(const SurveyedRecording& recording);
  /// Fingerprints without a walk (tables). Rows whose floor the site lacks are noted and skipped.
  void add(const sample::FingerprintRow& row, core::FloorId floor);

  /// kSurveyInsufficient when nothing was added that makes a fingerprint.
  core::Result<SurveyedSite> build();

 private:
  struct Instance {
    site::FingerprintRecord record;
    std::vector<site::MapReading> readings;
  };

  void add_scan(const radio::Query& query, const sample::WifiScan& scan, const LabelledPath& path);
  void note_stretches(const LabelledPath& path);
  void learn_headings();
  site::RadioMapStorage freeze_radio_map(QualityReport& quality) const;

  site::SiteParts parts_;
  std::shared_ptr<const site::Site> site_;
  Options options_;
  QualityReport quality_;
  MovingTransmitterFilter moving_;
  MagneticSurvey magnetic_;
  std::vector<Instance> instances_;
  std::vector<std::vector<LabelledPath::Stretch>> stretches_;  ///< Per floor.
  std::vector<std::set<std::uint32_t>> recordings_on_floor_;
  std::set<std::pair<core::TransmitterId, core::DeviceTime>> heard_before_;
  std::uint32_t recording_count_ = 0;
};

}  // namespace waylode::survey
