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
  /// From where the walker was at `time` to where the last step ended; from the oldest point known
  /// when `time` is older. Zero after the last step. Between the ends of a step the way is
  /// straight.
  core::Vector2 since_m(core::DeviceTime time) const;
  /// Where a walker in mid-step is beyond the end of the last one: on as before for one step's
  /// time, still there for as long again, and at the end of the last step when no step came.
  core::Vector2 beyond_m(core::DeviceTime time) const;
  /// No step, or the last one ended by `time`.
  bool is_in_order(core::DeviceTime time) const { return !last_ || last_->end <= time; }
  void clear();

 private:
  struct Point {
    core::DeviceTime time;
    core::Vector2 path_m;
  };
  std::deque<Point> points_;
  std::optional<observation::MotionDelta> last_;
};

}  // namespace waylode::fusion
