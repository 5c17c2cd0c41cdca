// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "datasets/dataset.hpp"
#include "waylode/log/log_reader.hpp"

namespace waylode::cli {

/// log::load_recording; a log that ends too early or has bad records is noted to `log` in one line.
core::Result<log::Recording> load_noted(const std::filesystem::path& path,
                                        const core::LogSink& log);

/// Reads a log with marks for judging: truths are its marks; Wi-Fi readings last heard before the
/// first mark are dropped. Damage is noted as above.
core::Result<TestRecording> load_marked_log(const std::filesystem::path& path,
                                            const site::Site& site,
                                            std::optional<core::FloorId> default_floor,
                                            const core::LogSink& log);

/// Reads a log as one without marks: readings last heard before the first mark are dropped, then
/// the marks themselves.
core::Result<std::vector<sample::Sample>> load_unlabelled_log(const std::filesystem::path& path,
                                                              const site::Site& site,
                                                              std::optional<core::FloorId> floor);

/// A test whose marks name its floors; reads the log once to know them. A test on a floor without a
/// radio map is kMapMissing; one without marks is kLogLacksRecords.
core::Result<TestCase> make_log_test(const std::filesystem::path& path,
                                     const std::shared_ptr<const pipeline::Model>& model,
                                     const std::string& site_name, const core::LogSink& log);

/// Whether the radio map holds a fingerprint of the floor.
bool is_mapped(const site::Site& site, core::FloorId floor);

}  // namespace waylode::cli
