// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pdr/extremum_finder.hpp"

namespace waylode::pdr {

std::optional<Extremum> ExtremumFinder::add(core::DeviceTime time, double value) {
  if (!last_) {
    last_ = Extremum{time, value, false};
    return std::nullopt;
  }
  // [Zhong2017] 2.4: strict inequalities there, which lose a peak of two equal values.
  if (value == last_->value) return std::nullopt;
  const Slope slope = value > last_->value ? Slope::kRising : Slope::kFalling;
  std::optional<Extremum> turned;
  if (slope_ != Slope::kUnknown && slope != slope_) {
    turned = last_;
    turned->is_peak = slope_ == Slope::kRising;
  }
  slope_ = slope;
  last_ = Extremum{time, value, false};
  return turned;
}

}  // namespace waylode::pdr
