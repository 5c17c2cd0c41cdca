// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "waylode/core/geometry.hpp"
#include "waylode/core/id.hpp"
#include "waylode/core/time.hpp"

namespace waylode::core {

enum class FixState : std::uint8_t {
  kUnknown,        ///< Nothing worth showing: say so, draw nothing.
  kOutside,        ///< Off the surveyed area.
  kLowConfidence,  ///< A position, but with wide doubt.
  kOk,
};

constexpr const char* to_string(FixState state) {
  switch (state) {
    case FixState::kUnknown:
      return "unknown";
    case FixState::kOutside:
      return "outside";
    case FixState::kLowConfidence:
      return "low_confidence";
    case FixState::kOk:
      break;
  }
  return "ok";
}

/// Where a person is thought to be: the mean and covariance of the estimator's distribution.
struct Belief {
  FloorId floor;
  double floor_probability = 0.0;
  Vector2 position_m = Vector2::Zero();         ///< Floor frame.
  Matrix2 covariance_m2 = Matrix2::Identity();  ///< Floor frame.

  bool operator==(const Belief&) const = default;
};

struct Provenance {
  std::string method;
  std::uint64_t map_version = 0;
  std::optional<DeviceTime> last_scan;  ///< Delivery of the newest radio scan that was used.

  bool operator==(const Provenance&) const = default;
};

/// The answer for one instant. `belief` is what the estimator holds whatever the state says; a
/// front end shows a position only for kOk and kLowConfidence. No belief, no position: never 0,0.
struct Fix {
  DeviceTime time;
  FixState state = FixState::kUnknown;
  std::optional<Belief> belief;
  Provenance provenance;

  bool operator==(const Fix&) const = default;
};

}  // namespace waylode::core
