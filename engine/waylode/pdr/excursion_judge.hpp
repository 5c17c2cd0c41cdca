// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>

#include "waylode/core/result.hpp"
#include "waylode/core/time.hpp"

namespace waylode::pdr {

/// Tells a turn of the way from a look aside. Somebody who lets others by, or takes a photo, turns
/// away from the course and comes back to it; somebody who turns a corner stays on the new course.
/// The verdict on a step waits until one of the two is plain. [Zhong2017] 2.5 throws away every
/// step of a scattered direction instead, and with them those of all corners.
class ExcursionJudge {
 public:
  struct Options {
    double leave_rad = 0.349;    ///< 20 degrees: so far off the course begins to be an excursion,
    double return_rad = 0.175;   ///< that ends, and began, where it was no farther than this.
    double settle_s = 3.0;       ///< So long on one new course makes a turn; > 0.
    double settled_rad = 0.105;  ///< Scatter of a steady course, above the sway of a stride; > 0.
    double longest_s = 7.0;      ///< Whoever is not back by then has turned; not below settle_s.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };
  enum class Verdict { kOnCourse, kTurning, kAside };

  explicit ExcursionJudge(const Options& options) : options_(options) {}

  /// By time. Values that are not finite are passed over.
  void add(core::DeviceTime time, double heading_rad);
  /// On a step at `time`, with the headings until now; nullopt: not yet plain. Steps are asked
  /// about in order, each until it has its verdict. `is_last`: nothing more will come.
  std::optional<Verdict> judge(core::DeviceTime time, bool is_last = false);

 private:
  struct Direction {
    core::DeviceTime time;
    double heading_rad = 0.0;
  };
  /// Mean direction in [from, to]; nullopt without any.
  std::optional<double> mean_rad(core::DeviceTime from, core::DeviceTime to) const;
  /// Off the course at a time, averaged over a step; nullopt where nothing is known.
  std::optional<double> off_course_rad(core::DeviceTime time) const;
  Verdict turn_to(core::DeviceTime time, double course_rad);

  Options options_;
  std::deque<Direction> directions_;
  std::optional<double> course_rad_;
  core::DeviceTime turning_until_;  ///< Steps until then belong to a turn that was found.
  core::DeviceTime aside_until_;    ///< Or to a look aside.
};

}  // namespace waylode::pdr
