// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "datasets/dataset.hpp"

namespace waylode::cli {

/// UJIIndoorLoc: a table of surveyed fingerprints and one of tests, each row a test of its own,
/// scored even when nothing was heard.
/// Floors are named "<building>/<floor>". Distances are in the tables' metres (EPSG:3857-like;
/// times 0.766 for metres on the ground).
core::Result<Dataset> load_uji_dataset(const std::filesystem::path& training,
                                       const std::filesystem::path& validation,
                                       const DatasetContext& context);

}  // namespace waylode::cli
