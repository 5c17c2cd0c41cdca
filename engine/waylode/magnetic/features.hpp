// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "waylode/core/geometry.hpp"

namespace waylode::magnetic {

/// What of the field does not depend on where the phone faces: the pair that is matched.
struct LevelField {
  double horizontal_ut = 0.0;  ///< Not negative.
  double vertical_ut = 0.0;    ///< Up positive.

  bool operator==(const LevelField&) const = default;
};

/// The field as [Zhou2016] describes it, in a level frame (x, y horizontal, z up).
struct FieldFeatures {
  double total_ut = 0.0;
  double horizontal_ut = 0.0;
  /// Of the horizontal part, counter-clockwise from +x; nullopt where there is none.
  std::optional<double> declination_rad;
  /// Above the horizontal, -pi/2 to pi/2; nullopt without a field.
  std::optional<double> inclination_rad;
};

/// nullopt for a field that is not finite.
std::optional<FieldFeatures> field_features(const core::Vector3& level_field_ut);

/// The field in the device frame, levelled by which way is up in that frame (any length but zero).
/// nullopt when either is not finite or nothing is up.
std::optional<LevelField> level_field(const core::Vector3& field_ut,
                                      const core::Vector3& up_in_device);

}  // namespace waylode::magnetic
