// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/id.hpp"
#include "waylode/eval/detail/report_data.hpp"
#include "waylode/site/site.hpp"

namespace waylode::eval::detail {

/// Floor metres to the pixels of one drawing: y up becomes y down.
struct PlanView {
  core::Vector2 centre_m = core::Vector2::Zero();
  double pixels_per_m = 1.0;

  static constexpr double kWidth_px = 480.0;
  static constexpr double kHeight_px = 360.0;

  /// Shows all points with a margin, and at least a room's worth of plan around them.
  static PlanView around(const std::vector<core::Vector2>& points_m);
  core::Vector2 pixels(const core::Vector2& point_m) const;
  /// Number pair "x y".
  std::string at(const core::Vector2& point_m) const;
};

/// The plans of the floors that are drawn, each defined once and referred to by every drawing.
class FloorPlans {
 public:
  /// The plan placed in a view, as a <use> element; nothing for a floor without plan.
  std::string use(const site::Site& site, core::FloorId floor, const PlanView& view);
  /// The definitions of all floors used so far.
  std::string definitions() const;

 private:
  std::map<std::pair<const site::Site*, std::uint16_t>, std::size_t> numbers_;
  std::vector<std::string> drawings_;
};

/// A bar of a round length with its label, at the lower left.
std::string scale_bar_svg(const PlanView& view);

/// One <figure> per recording: a drawing for each floor the person was on, with the mean error of
/// each method in the caption.
std::string recording_figure(const Recording& recording, const std::vector<MethodErrors>& methods,
                             FloorPlans& plans);

}  // namespace waylode::eval::detail
