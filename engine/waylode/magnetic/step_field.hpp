// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>

#include "waylode/core/geometry.hpp"
#include "waylode/core/time.hpp"
#include "waylode/magnetic/features.hpp"

namespace waylode::magnetic {

/// The levelled field of the last seconds, to be averaged over steps, which are told late.
class StepField {
 public:
  /// In order of time.
  void add(core::DeviceTime time, const LevelField& field);

  /// Mean of what was felt after `begin` and up to `end`: horizontal, vertical part. nullopt when
  /// nothing was, or not any more.
  std::optional<core::Vector2> mean_ut(core::DeviceTime begin, core::DeviceTime end) const;

 private:
  struct Reading {
    core::DeviceTime time;
    core::Vector2 field_ut = core::Vector2::Zero();
  };

  std::deque<Reading> readings_;
};

}  // namespace waylode::magnetic
