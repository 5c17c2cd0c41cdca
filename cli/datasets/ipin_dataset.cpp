// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "datasets/ipin_dataset.hpp"

#include <algorithm>

#include "datasets/split.hpp"
#include "datasets/test_recording.hpp"
#include "waylode/log/log_reader.hpp"
#include "waylode/survey/floors_from_marks.hpp"
#include "waylode/survey/map_builder.hpp"

namespace waylode::cli {
namespace {

namespace fs = std::filesystem;

bool has_log_name(const fs::path& path) {
  const std::string name = path.filename().string();
  return name.ends_with(".txt") || name.ends_with(".txt.zst");
}

core::Result<std::vector<fs::path>> find_logs(const fs::path& folder) {
  std::vector<fs::path> logs;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder, error)) {
    if (entry.is_regular_file() && has_log_name(entry.path())) logs.push_back(entry.path());
  }
  if (logs.empty()) {
    return core::fail(core::ErrorCode::kFileNotFound,
                      "no .txt or .txt.zst log below this folder; check the path", folder.string());
  }
  std::ranges::sort(logs);
  return logs;
}

/// The log without what only positioning needs, when just its marks are of interest.
survey::SurveyedRecording marks_only(const survey::SurveyedRecording& recording) {
  survey::SurveyedRecording marks{recording.name, {}, recording.default_floor};
  for (const sample::Sample& sample : recording.samples) {
    if (std::holds_alternative<sample::WaypointSample>(sample)) marks.samples.push_back(sample);
  }
  return marks;
}

}  // namespace

core::Result<Dataset> load_ipin_dataset(const fs::path& folder,
                                        const std::optional<fs::path>& split_path,
                                        const DatasetContext& context) {
  auto logs = find_logs(folder);
  if (!logs) return tl::unexpected(logs.error());
  std::vector<std::string> names;
  for (const fs::path& log : *logs) names.push_back(recording_name(log));
  constexpr std::uint64_t kSplitSeed = 1;
  core::Result<Split> split =
      split_path ? read_split(*split_path, {"log"}) : random_split(names, kSplitSeed);
  if (!split) return tl::unexpected(split.error());

  std::vector<survey::SurveyedRecording> training;
  std::vector<survey::SurveyedRecording> marks;  // Of all logs: they name the floors.
  std::vector<fs::path> tests;
  std::size_t done = 0;
  for (std::size_t i = 0; i < logs->size(); ++i) {
    if (context.progress) context.progress(++done, logs->size());
    const auto part = split->find(names[i]);
    if (part == split->end()) continue;
    auto recording = log::load_recording((*logs)[i]);
    if (!recording) return tl::unexpected(recording.error());
    survey::SurveyedRecording surveyed{names[i], std::move(recording->samples), std::nullopt};
    marks.push_back(marks_only(surveyed));
    if (part->second == Part::kTrain) {
      training.push_back(std::move(surveyed));
    } else {
      tests.push_back((*logs)[i]);
    }
  }
  auto parts = survey::floors_from_marks("ipin", marks);
  if (!parts) return tl::unexpected(parts.error());
  survey::MapBuilder builder(*std::move(parts), context.options.survey_options());
  for (const survey::SurveyedRecording& recording : training) builder.add(recording);
  auto built = builder.build();
  if (!built) return tl::unexpected(built.error());
  auto model = pipeline::Model::create(std::make_shared<site::Site>(std::move(built->parts)),
                                       context.options);
  if (!model) return tl::unexpected(model.error());

  Dataset dataset{"ipin", false, {}};
  for (const fs::path& path : tests) {
    TestCase test;
    test.name = recording_name(path);
    test.model = *model;
    test.load = [path, site = (*model)->site()] {
      return load_marked_log(path, *site, std::nullopt);
    };
    auto named = name_by_floor(std::move(test), path, "ipin");
    if (!named) return tl::unexpected(named.error());
    dataset.tests.push_back(*std::move(named));
  }
  return dataset;
}

}  // namespace waylode::cli
