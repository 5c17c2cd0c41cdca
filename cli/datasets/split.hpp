// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "waylode/core/log_sink.hpp"
#include "waylode/core/result.hpp"

namespace waylode::cli {

enum class Part {
  kTrain,
  kTest,
  kUnlabelled,  ///< Of the training part, kept aside as a recording without marks.
};

struct SplitEntry {
  Part part = Part::kTrain;
  std::size_t line = 0;  ///< Of the table that says so; 0 when dealt by random_split.
};

/// Which recordings train and which test, by key ("site/floor/trace" or a log's name).
using Split = std::map<std::string, SplitEntry>;

/// Reads a split table: CSV with a header that has `key_columns` and `split` (`train` or `test`) in
/// any order. Keys are the key columns joined by '/'. kTableInvalid names line and remedy, also for
/// a key that is `train` on one line and `test` on another; saying the same twice is no error.
core::Result<Split> read_split(const std::filesystem::path& path,
                               const std::vector<std::string>& key_columns);

/// One of `count` equal parts: the `number`th (from 1) is test.
struct Fold {
  std::uint64_t number = 1;
  std::uint64_t count = 4;
  bool operator==(const Fold&) const = default;
};

/// "K/N" with 1 <= K <= N and 2 <= N <= 1000.
core::Result<Fold> parse_fold(const std::string& text);

/// How recordings are dealt that no table names.
struct Dealing {
  std::uint64_t seed = 1;
  Fold fold{};
  double unlabelled_ratio = 0.0;  ///< Share of the training part to keep aside; 0 to < 1.
};

/// One fold of the keys as test, by default a quarter. The keys are shuffled by the seed, so each
/// is in the test part of exactly one fold of a seed; the same for any order of `keys`.
Split random_split(std::vector<std::string> keys, const Dealing& dealing);

/// Turns that share of the training part into kUnlabelled, rounded down, chosen by the seed.
void keep_aside(Split& split, const Dealing& dealing);

/// Notes to `log`, as one line, that rows of the table at `path` name logs that are not `found`.
void note_missing(const Split& split, const std::set<std::string>& found,
                  const std::filesystem::path& path, const core::LogSink& log);

/// A log's name as splits use it: the file name without ".zst" and without ".txt" or ".mcap".
std::string recording_name(const std::filesystem::path& path);

}  // namespace waylode::cli
