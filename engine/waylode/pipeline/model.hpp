// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "waylode/core/result.hpp"
#include "waylode/fusion/particle_tracker.hpp"
#include "waylode/magnetic/field_grid.hpp"
#include "waylode/pipeline/method.hpp"
#include "waylode/pipeline/options.hpp"
#include "waylode/radio/hotspot_classifier.hpp"
#include "waylode/radio/matcher.hpp"
#include "waylode/radio/place_likelihood.hpp"
#include "waylode/radio/positioner.hpp"
#include "waylode/radio/reference_map.hpp"
#include "waylode/site/site.hpp"

namespace waylode::pipeline {

/// A site made ready for positioning, shared by all sessions: its radio map indexed, and whatever
/// else a method needs, made when the first session asks for it. Any number of threads.
class Model {
 public:
  /// kMapMissing for a site without a radio map, kInvalidOptions for options out of range.
  static core::Result<std::shared_ptr<const Model>> create(std::shared_ptr<const site::Site> site,
                                                           const Options& options);
  ~Model();
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  const std::shared_ptr<const site::Site>& site() const { return site_; }
  const Options& options() const { return options_; }
  const radio::Matcher& matcher() const { return matcher_; }

  /// Makes what the method needs (regressions may train for seconds), so that sessions start at
  /// once. kMapMissing when the site lacks a map of it.
  core::Result<void> prepare(const Method& method) const;

  /// How this part places scans; not kNone.
  core::Result<std::shared_ptr<const radio::Positioner>> positioner(RadioPart part) const;
  /// How scans are placed near a place.
  core::Result<std::shared_ptr<const radio::Positioner>> near_positioner() const;
  /// Knows phones' hotspots by address and name; lives as long as the model.
  const radio::HotspotClassifier& hotspots() const;
  /// The map gathered to reference points; lives as long as the model.
  core::Result<const radio::ReferenceMap*> reference_map() const;
  /// How scans fit every place; lives as long as the model.
  core::Result<const radio::PlaceLikelihood*> places() const;
  /// Per floor: where people can be, by its plan, and the magnetic field if it was surveyed.
  fusion::Terrain terrain() const;
  /// Per floor. kMapMissing without a magnetic map.
  core::Result<std::shared_ptr<const std::vector<magnetic::FieldGrid>>> fields() const;

 private:
  struct Shared;
  Model(std::shared_ptr<const site::Site> site, const Options& options, radio::Matcher matcher);

  std::shared_ptr<const site::Site> site_;
  Options options_;
  radio::Matcher matcher_;
  std::unique_ptr<Shared> shared_;
};

}  // namespace waylode::pipeline
