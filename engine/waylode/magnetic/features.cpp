// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/magnetic/features.hpp"

#include <cmath>

namespace waylode::magnetic {

std::optional<FieldFeatures> field_features(const core::Vector3& level_field_ut) {
  if (!level_field_ut.allFinite()) return std::nullopt;
  FieldFeatures features;
  features.total_ut = level_field_ut.stableNorm();                 // [Zhou2016] eq. (6)
  features.horizontal_ut = level_field_ut.head<2>().stableNorm();  // [Zhou2016] eq. (7)
  if (features.horizontal_ut > 0.0) {
    features.declination_rad =
        std::atan2(level_field_ut.y(), level_field_ut.x());  // [Zhou2016] eq. (8)
  }
  if (features.total_ut > 0.0) {
    features.inclination_rad =
        std::atan2(level_field_ut.z(), features.horizontal_ut);  // [Zhou2016] eq. (9)
  }
  return features;
}

std::optional<LevelField> level_field(const core::Vector3& field_ut,
                                      const core::Vector3& up_in_device) {
  if (!field_ut.allFinite() || !up_in_device.allFinite()) return std::nullopt;
  const double up_norm = up_in_device.stableNorm();
  if (!(up_norm > 0.0)) return std::nullopt;
  const core::Vector3 up = up_in_device / up_norm;
  const double vertical_ut = field_ut.dot(up);
  return LevelField{(field_ut - vertical_ut * up).norm(), vertical_ut};
}

}  // namespace waylode::magnetic
