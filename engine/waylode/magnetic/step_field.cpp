// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/magnetic/step_field.hpp"

namespace waylode::magnetic {

void StepField::add(core::DeviceTime time, const LevelField& field) {
  constexpr core::Duration kKept = std::chrono::seconds(5);  // A slow step, told late.
  while (!readings_.empty() && readings_.front().time < time - kKept) readings_.pop_front();
  readings_.push_back({time, {field.horizontal_ut, field.vertical_ut}});
}

std::optional<core::Vector2> StepField::mean_ut(core::DeviceTime begin,
                                                core::DeviceTime end) const {
  core::Vector2 sum_ut = core::Vector2::Zero();
  int count = 0;
  for (const Reading& reading : readings_) {
    if (reading.time <= begin || reading.time > end) continue;
    sum_ut += reading.field_ut;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum_ut / count;
}

}  // namespace waylode::magnetic
