// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "waylode/core/log_sink.hpp"
#include "waylode/core/result.hpp"
#include "waylode/experiment/outcome.hpp"
#include "waylode/pipeline/options.hpp"

namespace waylode::cli {

/// The papers' questions asked of the public recordings below `data` (folders ilc, ipin2023,
/// oxford-steps, uji-mag as docs/benchmarks.md names them). A folder that is not there is noted in
/// an outcome without figures; one that cannot be read is an error. `paper` is "wu2019", ...
core::Result<std::vector<experiment::Outcome>> reproduce_on_recordings(
    const std::string& paper, const std::filesystem::path& data, const pipeline::Options& options,
    const core::LogSink& log);

}  // namespace waylode::cli
