// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "datasets/dataset.hpp"

namespace waylode::cli {

/// The Indoor Location Competition's folders: DIR/<site>/<floor>/path_data_files/*.txt[.zst],
/// beside them floor_info.json and geojson_map.json, both optional. `split` has columns site,
/// floor, trace, split; without it a seeded quarter of each floor's traces is test. A test on a
/// floor without a map is kMapMissing; sites without tests are not mapped. Nothing is written.
core::Result<Dataset> load_ilc_dataset(const std::filesystem::path& folder,
                                       const std::optional<std::filesystem::path>& split,
                                       const DatasetContext& context);

}  // namespace waylode::cli
