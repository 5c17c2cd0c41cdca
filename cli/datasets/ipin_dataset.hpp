// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "datasets/dataset.hpp"

namespace waylode::cli {

/// GetSensorData logs anywhere below `folder`. `split` has columns log, split; without it a seeded
/// quarter of the logs is test, and .txt files that are no logs are passed over. Floors are those
/// that the logs' marks name. Two logs of one name are kInvalidArgument. Nothing is written.
core::Result<Dataset> load_ipin_dataset(const std::filesystem::path& folder,
                                        const std::optional<std::filesystem::path>& split,
                                        const DatasetContext& context);

}  // namespace waylode::cli
