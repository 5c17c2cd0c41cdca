// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "test_support.hpp"

#include <cstdlib>
#include <stdexcept>

namespace waylode::test {

std::filesystem::path source_root() { return WAYLODE_SOURCE_DIR; }

std::optional<std::filesystem::path> data_root() {
  const char* variable = std::getenv("WAYLODE_DATA");
  const std::filesystem::path root = variable != nullptr ? std::filesystem::path(variable)
                                                         : source_root() / ".." / "shared" / "data";
  if (!std::filesystem::is_directory(root)) return std::nullopt;
  return root;
}

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "waylode_test_XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot create " + pattern);
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace waylode::test
