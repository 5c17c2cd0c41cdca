// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "waylode/core/result.hpp"
#include "waylode/sample/sample.hpp"

namespace waylode::log {

/// A fingerprint table in the format of UJIIndoorLoc: CSV, plain or zstd, with a header that names
/// the columns WAP<n> (any number of them), LONGITUDE, LATITUDE, FLOOR and BUILDINGID in any order;
/// other columns are passed over.
///
/// A WAP cell is an RSSI in dBm or 100, not heard; the transmitter is TransmitterId::column(n).
/// `position_m` is (LONGITUDE, LATITUDE), metres of the data set's projection; building and floor
/// are the cells' text. Rows where nothing was heard stay, with no readings.
///
/// A table is read whole or not at all: kFileNotFound, kFileUnreadable, or kTableInvalid with the
/// place as "file:line" for a missing or doubled column, a short or long row, a cell that is no
/// number or out of range, or a file that ends too early.
core::Result<std::vector<sample::FingerprintRow>> read_uji_table(const std::filesystem::path& path);

/// The same from memory; `name` stands in for the path in errors.
core::Result<std::vector<sample::FingerprintRow>> read_uji_table_bytes(std::string_view bytes,
                                                                       std::string_view name);

}  // namespace waylode::log
