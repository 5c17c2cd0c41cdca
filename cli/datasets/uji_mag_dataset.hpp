// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "waylode/core/result.hpp"
#include "waylode/experiment/magnetic_matching.hpp"

namespace waylode::cli {

/// UJIIndoorLoc-Mag: walks along the corridors of one laboratory, 10 readings a second.
struct UjiMagDataset {
  std::vector<experiment::FieldWalk> training;  ///< "lines" and "curves", by name.
  std::vector<experiment::FieldWalk> tests;     ///< "tests", by name.
};

/// From the archive as it is distributed (tar or zip, packed or not). Places become metres east and
/// north of (39.9939, -0.0738). kTableInvalid with "file:line" for whatever is not as it should be,
/// kLogLacksRecords when training or tests are missing, errors of read_archive.
core::Result<UjiMagDataset> load_uji_mag_dataset(const std::filesystem::path& archive);

/// One file of it: lines `t_ms mag[3]_uT acceleration[3] orientation[3]_deg`, then `<n>` and n
/// lines `lat0 lon0 lat1 lon1 first last`.
core::Result<experiment::FieldWalk> parse_uji_mag_walk(std::string_view text,
                                                       std::string_view place);

}  // namespace waylode::cli
