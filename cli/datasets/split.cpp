// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "datasets/split.hpp"

#include <algorithm>
#include <sstream>

#include "waylode/core/file.hpp"
#include "waylode/core/rng.hpp"

namespace waylode::cli {
namespace {

std::vector<std::string> cells_of(std::string line) {
  if (!line.empty() && line.back() == '\r') line.pop_back();
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) {
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') {
      cell = cell.substr(1, cell.size() - 2);
    }
    cells.push_back(cell);
  }
  return cells;
}

tl::unexpected<core::Error> refuse(const std::filesystem::path& path, std::size_t line,
                                   const std::string& message) {
  return core::fail(core::ErrorCode::kTableInvalid, message,
                    path.string() + ":" + std::to_string(line));
}

}  // namespace

core::Result<Split> read_split(const std::filesystem::path& path,
                               const std::vector<std::string>& key_columns) {
  auto text = core::read_file(path);
  if (!text) return tl::unexpected(text.error());
  std::istringstream lines(*text);
  std::string line;
  std::getline(lines, line);
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (line.starts_with(kByteOrderMark)) line.erase(0, kByteOrderMark.size());
  const std::vector<std::string> header = cells_of(line);

  std::vector<std::size_t> columns;
  std::vector<std::string> wanted = key_columns;
  wanted.push_back("split");
  for (const std::string& name : wanted) {
    const auto found = std::ranges::find(header, name);
    if (found == header.end()) {
      return refuse(path, 1, "no column '" + name + "' in the header; write one");
    }
    columns.push_back(static_cast<std::size_t>(found - header.begin()));
  }
  Split split;
  for (std::size_t number = 2; std::getline(lines, line); ++number) {
    if (line.empty() || line == "\r") continue;
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() != header.size()) {
      return refuse(path, number,
                    "expected " + std::to_string(header.size()) + " cells, found " +
                        std::to_string(cells.size()));
    }
    std::string key;
    for (std::size_t i = 0; i + 1 < columns.size(); ++i) {
      key += (i == 0 ? "" : "/") + cells[columns[i]];
    }
    const std::string& part = cells[columns.back()];
    if (part != "train" && part != "test") {
      return refuse(path, number, "split is '" + part + "'; write 'train' or 'test'");
    }
    split[key] = part == "train" ? Part::kTrain : Part::kTest;
  }
  if (split.empty()) return refuse(path, 1, "the split names no recording");
  return split;
}

Split random_split(std::vector<std::string> keys, std::uint64_t seed) {
  std::ranges::sort(keys);
  core::Rng rng(seed);
  for (std::size_t i = keys.size(); i > 1; --i) std::swap(keys[i - 1], keys[rng.below(i)]);
  Split split;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    split[keys[i]] = i < keys.size() / 4 ? Part::kTest : Part::kTrain;
  }
  return split;
}

std::string recording_name(const std::filesystem::path& path) {
  std::filesystem::path name = path.filename();
  if (name.extension() == ".zst") name = name.stem();
  if (name.extension() == ".txt" || name.extension() == ".mcap") name = name.stem();
  return name.string();
}

}  // namespace waylode::cli
