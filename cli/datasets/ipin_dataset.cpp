// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "datasets/ipin_dataset.hpp"

#include <map>
#include <set>

#include "datasets/log_files.hpp"
#include "datasets/split.hpp"
#include "datasets/test_recording.hpp"
#include "waylode/survey/floors_from_marks.hpp"
#include "waylode/survey/map_builder.hpp"

namespace waylode::cli {
namespace {

namespace fs = std::filesystem;

/// The log without what only positioning needs, when just its marks are of interest.
survey::SurveyedRecording marks_only(const survey::SurveyedRecording& recording) {
  survey::SurveyedRecording marks{recording.name, {}, recording.default_floor};
  for (const sample::Sample& sample : recording.samples) {
    if (std::holds_alternative<sample::WaypointSample>(sample)) marks.samples.push_back(sample);
  }
  return marks;
}

/// Two logs of one name cannot be told apart by a split; only those that it names matter.
core::Result<std::map<std::string, fs::path>> name_logs(const std::vector<fs::path>& logs,
                                                        const std::optional<Split>& split) {
  std::map<std::string, fs::path> named;
  for (const fs::path& log : logs) {
    const std::string name = recording_name(log);
    if (split && !split->contains(name)) continue;
    const auto [entry, added] = named.try_emplace(name, log);
    if (!added) {
      return core::fail(core::ErrorCode::kInvalidArgument,
                        "has the same name as " + entry->second.string() + "; rename one of them",
                        log.string());
    }
  }
  return named;
}

class IpinLoader {
 public:
  IpinLoader(const fs::path& folder, const std::optional<fs::path>& split_path,
             const DatasetContext& context)
      : folder_(folder), split_path_(split_path), context_(context) {}

  core::Result<Dataset> load() {
    if (auto read = read_logs(); !read) return tl::unexpected(read.error());
    if (!split_) {
      std::vector<std::string> names;
      for (const survey::SurveyedRecording& recording : recordings_) {
        names.push_back(recording.name);
      }
      split_ = random_split(std::move(names), context_.dealing);
    }
    keep_aside(*split_, context_.dealing);
    auto model = build_model();
    if (!model) return tl::unexpected(model.error());
    Dataset dataset{"ipin", false, {}, {}};
    for (const survey::SurveyedRecording& recording : recordings_) {
      if (part_of(recording.name) == Part::kUnlabelled) {
        add_unlabelled(recording.name, *model, dataset);
      }
      if (part_of(recording.name) != Part::kTest) continue;
      // Damage was noted when the log was read for its floors.
      auto test = make_log_test(logs_.at(recording.name), *model, "ipin", {});
      if (!test) return tl::unexpected(test.error());
      dataset.tests.push_back(*std::move(test));
    }
    return dataset;
  }

 private:
  Part part_of(const std::string& name) const { return split_->at(name).part; }

  void add_unlabelled(const std::string& name, const std::shared_ptr<const pipeline::Model>& model,
                      Dataset& dataset) const {
    dataset.unlabelled.push_back({name, "ipin", model, [path = logs_.at(name), model] {
                                    return load_unlabelled_log(path, *model->site(), std::nullopt);
                                  }});
  }

  core::Result<void> find_logs() {
    if (split_path_) {
      auto read = read_split(*split_path_, {"log"});
      if (!read) return tl::unexpected(read.error());
      split_ = *std::move(read);
    }
    const auto found = text_logs_below(folder_);
    if (!found) return tl::unexpected(found.error());
    auto named = name_logs(*found, split_);
    if (!named) return tl::unexpected(named.error());
    logs_ = *std::move(named);
    if (logs_.empty()) {
      return core::fail(core::ErrorCode::kFileNotFound,
                        "no .txt or .txt.zst log below this folder that the split names; check "
                        "folder and split",
                        folder_.string());
    }
    if (split_) {
      std::set<std::string> names;
      for (const auto& [name, path] : logs_) names.insert(name);
      note_missing(*split_, names, *split_path_, context_.log);
    }
    return {};
  }

  /// Without a split, files that are no logs are passed over with a note.
  core::Result<void> read_logs() {
    if (auto found = find_logs(); !found) return found;
    std::size_t done = 0;
    for (const auto& [name, path] : logs_) {
      if (context_.progress) context_.progress(++done, logs_.size());
      auto recording = load_noted(path, context_.log);
      if (!recording) {
        if (split_ || recording.error().code != core::ErrorCode::kLogUnrecognised) {
          return tl::unexpected(recording.error());
        }
        if (context_.log) {
          context_.log(core::LogLevel::kWarning, "evaluate", path.string() + ": no log; left out");
        }
        continue;
      }
      survey::SurveyedRecording surveyed{name, std::move(recording->samples), std::nullopt};
      const bool for_marks = split_ && part_of(name) != Part::kTrain;
      recordings_.push_back(for_marks ? marks_only(surveyed) : std::move(surveyed));
    }
    return {};
  }

  /// The floors are those of all logs' marks, the map is of the training logs.
  core::Result<std::shared_ptr<const pipeline::Model>> build_model() const {
    std::vector<survey::SurveyedRecording> marks;
    for (const survey::SurveyedRecording& recording : recordings_) {
      marks.push_back(marks_only(recording));
    }
    auto parts = survey::floors_from_marks("ipin", marks);
    if (!parts) return tl::unexpected(at_folder(parts.error()));
    survey::MapBuilder builder(*std::move(parts), context_.options.survey_options());
    for (const survey::SurveyedRecording& recording : recordings_) {
      if (part_of(recording.name) == Part::kTrain) builder.add(recording);
    }
    auto built = builder.build();
    if (!built) return tl::unexpected(at_folder(built.error()));
    return pipeline::Model::create(std::make_shared<site::Site>(std::move(built->parts)),
                                   context_.options);
  }

  core::Error at_folder(core::Error error) const {
    if (error.place.empty()) error.place = folder_.string();
    return error;
  }

  const fs::path& folder_;
  const std::optional<fs::path>& split_path_;
  const DatasetContext& context_;
  std::optional<Split> split_;
  std::map<std::string, fs::path> logs_;               ///< By name; all are in the split, if given.
  std::vector<survey::SurveyedRecording> recordings_;  ///< By name.
};

}  // namespace

core::Result<Dataset> load_ipin_dataset(const fs::path& folder,
                                        const std::optional<fs::path>& split,
                                        const DatasetContext& context) {
  return IpinLoader(folder, split, context).load();
}

}  // namespace waylode::cli
