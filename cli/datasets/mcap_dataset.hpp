// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "datasets/dataset.hpp"
#include "waylode/site/site.hpp"

namespace waylode::cli {

/// Logs of any known format with marks, judged on a site that was built before.
core::Result<Dataset> load_log_dataset(std::shared_ptr<const site::Site> site,
                                       const std::vector<std::filesystem::path>& logs,
                                       const DatasetContext& context);

}  // namespace waylode::cli
