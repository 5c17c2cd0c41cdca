// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "datasets/dataset.hpp"

namespace waylode::cli {

/// Reads a log with marks for judging: truths are its marks; Wi-Fi readings last heard before the
/// first mark are dropped.
core::Result<TestRecording> load_marked_log(const std::filesystem::path& path,
                                            const site::Site& site,
                                            std::optional<core::FloorId> default_floor);

/// Fills in the test's group and, when it has just one, its floor, from its truths. A test on a
/// floor without a radio map is kMapMissing; one without marks is kLogLacksRecords.
core::Result<TestCase> name_by_floor(TestCase test, const std::filesystem::path& path,
                                     const std::string& site_name);

/// Whether the radio map holds a fingerprint of the floor.
bool is_mapped(const site::Site& site, core::FloorId floor);

}  // namespace waylode::cli
