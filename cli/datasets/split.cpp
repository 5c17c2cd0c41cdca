// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "datasets/split.hpp"

#include <algorithm>
#include <charconv>

#include "datasets/csv.hpp"
#include "waylode/core/file.hpp"
#include "waylode/core/rng.hpp"

namespace waylode::cli {
namespace {

tl::unexpected<core::Error> refuse(const std::filesystem::path& path, std::size_t line,
                                   const std::string& message) {
  return core::fail(core::ErrorCode::kTableInvalid, message,
                    path.string() + ":" + std::to_string(line));
}

/// Places of the wanted columns in the header.
core::Result<std::vector<std::size_t>> find_columns(const std::filesystem::path& path,
                                                    const CsvRow& header,
                                                    const std::vector<std::string>& wanted) {
  std::vector<std::size_t> columns;
  for (const std::string& name : wanted) {
    const auto found = std::ranges::find(header.cells, name);
    if (found == header.cells.end()) {
      return refuse(path, header.line, "no column '" + name + "' in the header; write one");
    }
    columns.push_back(static_cast<std::size_t>(found - header.cells.begin()));
  }
  return columns;
}

/// `columns`: those of the key, then that of the part.
core::Result<void> add_row(const std::filesystem::path& path, const CsvRow& row,
                           const std::vector<std::size_t>& columns, Split& split) {
  std::string key;
  for (std::size_t i = 0; i + 1 < columns.size(); ++i) {
    key += (i == 0 ? "" : "/") + row.cells[columns[i]];
  }
  const std::string& word = row.cells[columns.back()];
  if (word != "train" && word != "test") {
    return refuse(path, row.line, "split is '" + word + "'; write 'train' or 'test'");
  }
  const Part part = word == "train" ? Part::kTrain : Part::kTest;
  const auto [entry, added] = split.try_emplace(key, SplitEntry{part, row.line});
  if (!added && entry->second.part != part) {
    return refuse(path, row.line,
                  "'" + key + "' is '" + word + "' here and not on line " +
                      std::to_string(entry->second.line) + "; keep one of the two");
  }
  return {};
}

void shuffle(std::vector<std::string>& keys, std::uint64_t seed) {
  std::ranges::sort(keys);
  core::Rng rng(seed);
  for (std::size_t i = keys.size(); i > 1; --i) std::swap(keys[i - 1], keys[rng.below(i)]);
}

}  // namespace

core::Result<Split> read_split(const std::filesystem::path& path,
                               const std::vector<std::string>& key_columns) {
  const auto text = core::read_file(path);
  if (!text) return tl::unexpected(text.error());
  const auto rows = parse_csv(*text, path.string());
  if (!rows) return tl::unexpected(rows.error());
  const CsvRow header = rows->empty() ? CsvRow{1, {}} : rows->front();
  std::vector<std::string> wanted = key_columns;
  wanted.push_back("split");
  const auto columns = find_columns(path, header, wanted);
  if (!columns) return tl::unexpected(columns.error());

  Split split;
  for (std::size_t i = 1; i < rows->size(); ++i) {
    const CsvRow& row = (*rows)[i];
    if (row.cells.size() != header.cells.size()) {
      return refuse(path, row.line,
                    "expected " + std::to_string(header.cells.size()) + " cells, found " +
                        std::to_string(row.cells.size()));
    }
    if (auto added = add_row(path, row, *columns, split); !added) {
      return tl::unexpected(added.error());
    }
  }
  if (split.empty()) return refuse(path, header.line, "the split names no recording");
  return split;
}

core::Result<Fold> parse_fold(const std::string& text) {
  constexpr std::uint64_t kMostFolds = 1000;
  Fold fold;
  const char* const end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, fold.number);
  if (number.ec == std::errc() && number.ptr != end && *number.ptr == '/') {
    const auto count = std::from_chars(number.ptr + 1, end, fold.count);
    if (count.ec == std::errc() && count.ptr == end && fold.number >= 1 &&
        fold.number <= fold.count && fold.count >= 2 && fold.count <= kMostFolds) {
      return fold;
    }
  }
  return core::fail(core::ErrorCode::kInvalidArgument,
                    "'" + text + "' is no fold; write K/N, such as 2/4, with K from 1 to N",
                    "--fold");
}

Split random_split(std::vector<std::string> keys, const Dealing& dealing) {
  shuffle(keys, dealing.seed);
  const std::size_t begin = (dealing.fold.number - 1) * keys.size() / dealing.fold.count;
  const std::size_t end = dealing.fold.number * keys.size() / dealing.fold.count;
  Split split;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    split[keys[i]].part = i >= begin && i < end ? Part::kTest : Part::kTrain;
  }
  return split;
}

void keep_aside(Split& split, const Dealing& dealing) {
  std::vector<std::string> training;
  for (const auto& [key, entry] : split) {
    if (entry.part == Part::kTrain) training.push_back(key);
  }
  // Another seed than the split's own, so that the two choices do not go together.
  shuffle(training, dealing.seed ^ 0x756e6c6162656c6cULL);
  const double wanted = dealing.unlabelled_ratio * static_cast<double>(training.size());
  for (std::size_t i = 0; i < training.size() && static_cast<double>(i + 1) <= wanted; ++i) {
    split[training[i]].part = Part::kUnlabelled;
  }
}

void note_missing(const Split& split, const std::set<std::string>& found,
                  const std::filesystem::path& path, const core::LogSink& log) {
  std::size_t missing = 0;
  const Split::value_type* first = nullptr;
  for (const Split::value_type& entry : split) {
    if (found.contains(entry.first)) continue;
    ++missing;
    if (first == nullptr || entry.second.line < first->second.line) first = &entry;
  }
  if (first == nullptr || !log) return;
  log(core::LogLevel::kWarning, "evaluate",
      path.string() + ":" + std::to_string(first->second.line) + ": " + std::to_string(missing) +
          " of " + std::to_string(split.size()) + " recordings match no log, the first is '" +
          first->first + "'");
}

std::string recording_name(const std::filesystem::path& path) {
  std::filesystem::path name = path.filename();
  if (name.extension() == ".zst") name = name.stem();
  if (name.extension() == ".txt" || name.extension() == ".mcap") name = name.stem();
  return name.string();
}

}  // namespace waylode::cli
