// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace waylode::test {

/// The project's root folder, for testdata/ and contract/.
std::filesystem::path source_root();

/// The real recordings: $WAYLODE_DATA, else ../shared/data beside the project; nullopt when absent.
/// Use it as: `const auto root = data_root(); if (!root) GTEST_SKIP() << kNoData;`
std::optional<std::filesystem::path> data_root();
inline constexpr const char* kNoData =
    "real recordings not found; set WAYLODE_DATA to the folder that holds ilc/, ipin2023/, ...";

/// A folder of its own for one test, removed with everything in it when the object goes.
class TemporaryFolder {
 public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace waylode::test
