// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/sample/sample.hpp"

#include <array>

namespace waylode::sample {

const char* kind_of(const Sample& sample) {
  static constexpr std::array kNames = {"accelerometer",
                                        "gyroscope",
                                        "magnetometer",
                                        "uncalibrated_accelerometer",
                                        "uncalibrated_gyroscope",
                                        "uncalibrated_magnetometer",
                                        "rotation",
                                        "barometer",
                                        "wifi_scan",
                                        "ble",
                                        "gnss",
                                        "waypoint"};
  static_assert(kNames.size() == std::variant_size_v<Sample>);
  return kNames[sample.index()];
}

}  // namespace waylode::sample
