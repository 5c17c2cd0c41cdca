// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "waylode/core/result.hpp"
#include "waylode/pdr/gravity_filter.hpp"
#include "waylode/sample/sample.hpp"
#include "waylode/site/magnetic_map.hpp"
#include "waylode/survey/labelled_path.hpp"

namespace waylode::survey {

/// Surveyed walks to a magnetic map: the levelled field, averaged along the walk, then in cells.
class MagneticSurvey {
 public:
  struct Options {
    bool build = true;        ///< Make a magnetic map at all.
    double spacing_m = 0.3;   ///< Of the walk that one reading averages.
    bool align_walks = true;  ///< Take each phone's constant part away, where walks share cells.
    site::MagneticMapBuilder::Options cells;
    pdr::GravityFilter::Options gravity;

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// `options` must be valid.
  explicit MagneticSurvey(const Options& options) : options_(options) {}

  /// One walk: samples by time, and where it led.
  void add(std::span<const sample::Sample> samples, const LabelledPath& path);

  /// Same walks in the same order, same map.
  site::MagneticMapStorage build() const;

 private:
  /// The field over one piece of a walk.
  struct Reading {
    core::FloorId floor;
    core::Vector2 position_m = core::Vector2::Zero();
    core::Vector2 field_ut = core::Vector2::Zero();  ///< Horizontal, vertical.
  };
  using Walk = std::vector<Reading>;

  static std::vector<Reading> readings_of(std::span<const sample::Sample> samples,
                                          const LabelledPath& path, const Options& options);
  /// Per walk, what to take away from its field.
  std::vector<core::Vector2> learn_offsets() const;

  Options options_;
  std::vector<Walk> walks_;
};

}  // namespace waylode::survey
