// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>

#include "waylode/core/geometry.hpp"
#include "waylode/core/time.hpp"
#include "waylode/observation/observation.hpp"

namespace waylode::fusion {

/// The displacement of a step as PDR tells it: unscaled, its heading taken as it is.
core::Vector2 displacement_m(const observation::MotionDelta& motion);

/// The way of the last half minute as PDR tells it, for what is known late.
class PathMemory {
 public:
  /// `motion` is finite, does not end before it begins nor before the last one ended.
  void add(const observation::MotionDelta& motion);
  /// Where the walker is at `time`, seen from the end of the last step. Before it: back along the
  /// way, straight between the ends of a step, to the oldest point known. After it, since a step is
  /// told when complete: on as before for one step's time, still there for as long again, and back
  /// at the end of the last step when no step came.
  core::Vector2 offset_m(core::DeviceTime time) const;
  /// No step, or the last one ended by `time`.
  bool is_in_order(core::DeviceTime time) const { return !last_ || last_->end <= time; }
  /// Since when the way is known; nullopt without a step.
  std::optional<core::DeviceTime> oldest() const;
  void clear();

 private:
  core::Vector2 back_m(core::DeviceTime time) const;
  core::Vector2 beyond_m(core::DeviceTime time) const;

  struct Point {
    core::DeviceTime time;
    core::Vector2 path_m;
  };
  std::deque<Point> points_;
  std::optional<observation::MotionDelta> last_;
};

}  // namespace waylode::fusion
