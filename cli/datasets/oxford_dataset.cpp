// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "datasets/oxford_dataset.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <system_error>

#include "datasets/archive.hpp"
#include "datasets/csv.hpp"
#include "waylode/core/file.hpp"

namespace waylode::cli {
namespace {

namespace fs = std::filesystem;
using core::ErrorCode;
using Files = std::map<std::string, std::string>;

/// A row of stats.csv, or what a recording's name tells.
struct Facts {
  std::string phone;
  std::string placement;
  std::string steps;  ///< As stats.csv counts them; empty where it does not.
};

template <typename Number>
bool parse_number(std::string_view text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

std::string trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(' ');
  if (begin == std::string_view::npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(' ') - begin + 1));
}

std::string lower_case(std::string text) {
  for (char& letter : text) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  return text;
}

tl::unexpected<core::Error> refuse(const std::string& file, std::size_t line, const char* message) {
  return core::fail(ErrorCode::kTableInvalid, message, file + ":" + std::to_string(line));
}

core::Result<std::vector<sample::AccelerometerSample>> parse_accelerometer(
    const std::string& text, const std::string& file) {
  const auto rows = parse_csv(text, file);
  if (!rows) return tl::unexpected(rows.error());
  std::vector<sample::AccelerometerSample> samples;
  samples.reserve(rows->size());
  for (const CsvRow& row : *rows) {
    std::int64_t time_ns = 0;
    int accuracy = 0;
    core::Vector3 force_mps2;
    const auto& cells = row.cells;
    const bool sound = cells.size() == 5 && parse_number(cells[0], time_ns) &&
                       parse_number(cells[1], accuracy) && parse_number(cells[2], force_mps2.x()) &&
                       parse_number(cells[3], force_mps2.y()) &&
                       parse_number(cells[4], force_mps2.z()) && force_mps2.allFinite();
    if (!sound) return refuse(file, row.line, "need t_ns,accuracy,ax,ay,az; mend the line");
    const core::DeviceTime time{core::Duration(time_ns)};
    if (!samples.empty() && time < samples.back().time) {
      return refuse(file, row.line, "the time goes back; sort the lines");
    }
    samples.push_back({time, force_mps2});
  }
  return samples;
}

/// Times at which a foot came down.
core::Result<std::vector<core::DeviceTime>> parse_steps(const std::string& text,
                                                        const std::string& file) {
  const auto rows = parse_csv(text, file);
  if (!rows) return tl::unexpected(rows.error());
  std::vector<core::DeviceTime> steps;
  int left_before = 1;
  int right_before = 1;
  core::DeviceTime before = core::DeviceTime::min();
  for (const CsvRow& row : *rows) {
    std::int64_t time_ns = 0;
    int left = 0;
    int right = 0;
    const auto& cells = row.cells;
    const bool sound = cells.size() == 3 && parse_number(cells[0], time_ns) &&
                       parse_number(cells[1], left) && parse_number(cells[2], right) &&
                       (left == 0 || left == 1) && (right == 0 || right == 1);
    if (!sound)
      return refuse(file, row.line, "need t_ns,left,right with switches 0 or 1; mend the line");
    const core::DeviceTime time{core::Duration(time_ns)};
    if (time < before) return refuse(file, row.line, "the time goes back; sort the lines");
    if (left > left_before) steps.push_back(time);
    if (right > right_before) steps.push_back(time);
    left_before = left;
    right_before = right;
    before = time;
  }
  return steps;
}

/// Of every stats.csv: recording to facts.
core::Result<std::map<std::string, Facts>> parse_stats(const Files& files) {
  std::map<std::string, Facts> facts;
  for (const auto& [file, text] : files) {
    if (fs::path(file).filename() != "stats.csv") continue;
    const auto rows = parse_csv(text, file);
    if (!rows) return tl::unexpected(rows.error());
    for (const CsvRow& row : *rows) {
      if (row.cells.front().starts_with('#')) continue;
      if (row.cells.size() != 7) {
        return refuse(file, row.line,
                      "need dir,user,phone,position,surface,duration,steps; mend the line");
      }
      facts[trimmed(row.cells[0])] = {trimmed(row.cells[2]), lower_case(trimmed(row.cells[3])),
                                      trimmed(row.cells[6])};
    }
  }
  return facts;
}

/// Of "<phone>_<user>_<surface>_<placement>_<number>".
Facts facts_of_name(const std::string& name) {
  std::vector<std::string> parts(1);
  for (const char letter : name) {
    if (letter == '_') {
      parts.emplace_back();
    } else {
      parts.back() += letter;
    }
  }
  if (parts.size() != 5) return {};
  return {parts[0], lower_case(parts[3]), ""};
}

core::Result<experiment::StepRecording> parse_recording(const Files& files, const fs::path& folder,
                                                        const Facts& facts) {
  const std::string accelerometer = (folder / "accelerometer.csv").string();
  const std::string switches = (folder / "stepcounter.csv").string();
  auto samples = parse_accelerometer(files.at(accelerometer), accelerometer);
  if (!samples) return tl::unexpected(samples.error());
  auto steps = parse_steps(files.at(switches), switches);
  if (!steps) return tl::unexpected(steps.error());
  std::erase_if(*steps, [&](core::DeviceTime time) {
    return samples->empty() || time < samples->front().time || time > samples->back().time;
  });
  return experiment::StepRecording{folder.filename().string(), facts.placement, facts.phone,
                                   *std::move(samples), *std::move(steps)};
}

core::Result<Files> read_folder(const fs::path& folder) {
  Files files;
  std::error_code error;
  fs::recursive_directory_iterator iterator(folder, error);
  for (; !error && iterator != fs::recursive_directory_iterator(); iterator.increment(error)) {
    std::error_code ignored;
    if (!iterator->is_regular_file(ignored) || iterator->path().extension() != ".csv") continue;
    auto text = core::read_file(iterator->path());
    if (!text) return tl::unexpected(text.error());
    files.emplace(iterator->path().string(), *std::move(text));
  }
  if (error) {
    return core::fail(ErrorCode::kFileUnreadable, "cannot list the folder: " + error.message(),
                      folder.string());
  }
  return files;
}

}  // namespace

core::Result<OxfordDataset> parse_oxford_dataset(const Files& files, const std::string& place) {
  const auto stats = parse_stats(files);
  if (!stats) return tl::unexpected(stats.error());
  OxfordDataset dataset;
  for (const auto& [file, text] : files) {
    if (fs::path(file).filename() != "stepcounter.csv") continue;
    const fs::path folder = fs::path(file).parent_path();
    const std::string name = folder.filename().string();
    const auto listed = stats->find(name);
    if (!stats->empty() && listed == stats->end()) {
      dataset.notes.push_back(name + ": left out, since stats.csv does not list it");
      continue;
    }
    if (!files.contains((folder / "accelerometer.csv").string())) {
      dataset.notes.push_back(name + ": left out, since it has no accelerometer.csv");
      continue;
    }
    const Facts facts = listed == stats->end() ? facts_of_name(name) : listed->second;
    auto recording = parse_recording(files, folder, facts);
    if (!recording) return tl::unexpected(recording.error());
    if (!facts.steps.empty() && facts.steps != std::to_string(recording->steps.size())) {
      dataset.notes.push_back(name + ": " + std::to_string(recording->steps.size()) +
                              " steps by the switches, " + facts.steps + " by stats.csv");
    }
    dataset.recordings.push_back(*std::move(recording));
  }
  if (dataset.recordings.empty()) {
    return core::fail(ErrorCode::kLogLacksRecords,
                      "no folder with accelerometer.csv and stepcounter.csv; check the path",
                      place);
  }
  std::ranges::stable_sort(dataset.recordings, {}, &experiment::StepRecording::name);
  return dataset;
}

core::Result<OxfordDataset> load_oxford_dataset(const fs::path& path) {
  std::error_code ignored;
  const auto files = fs::is_directory(path, ignored) ? read_folder(path) : read_archive(path);
  if (!files) return tl::unexpected(files.error());
  return parse_oxford_dataset(*files, path.string());
}

}  // namespace waylode::cli
