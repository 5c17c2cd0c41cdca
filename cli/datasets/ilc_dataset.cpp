// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "datasets/ilc_dataset.hpp"

#include <algorithm>
#include <map>

#include "datasets/coverage.hpp"
#include "datasets/split.hpp"
#include "datasets/test_recording.hpp"
#include "waylode/core/file.hpp"
#include "waylode/log/log_reader.hpp"
#include "waylode/site/plan_geojson.hpp"
#include "waylode/survey/map_builder.hpp"

namespace waylode::cli {
namespace {

namespace fs = std::filesystem;

struct FloorFolder {
  std::string name;
  fs::path path;
  std::vector<fs::path> train;
  std::vector<fs::path> test;
  std::vector<MarkedPath> train_paths;
};

struct SiteFolder {
  std::string name;
  std::vector<FloorFolder> floors;
};

std::vector<fs::path> sorted_entries(const fs::path& folder, bool folders) {
  std::vector<fs::path> entries;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (entry.is_directory() == folders) entries.push_back(entry.path());
  }
  std::ranges::sort(entries);
  return entries;
}

/// Finds sites, floors and logs; deals the logs into train and test.
core::Result<std::vector<SiteFolder>> list_folders(const fs::path& folder,
                                                   const std::optional<Split>& given_split) {
  constexpr std::uint64_t kSplitSeed = 1;
  std::vector<SiteFolder> sites;
  std::size_t log_count = 0;
  for (const fs::path& site_path : sorted_entries(folder, true)) {
    SiteFolder site{site_path.filename().string(), {}};
    for (const fs::path& floor_path : sorted_entries(site_path, true)) {
      FloorFolder floor{floor_path.filename().string(), floor_path, {}, {}, {}};
      const std::vector<fs::path> logs = sorted_entries(floor_path / "path_data_files", false);
      const std::string prefix = site.name + "/" + floor.name + "/";
      std::vector<std::string> keys;
      for (const fs::path& log : logs) keys.push_back(prefix + recording_name(log));
      const Split split = given_split ? *given_split : random_split(keys, kSplitSeed);
      for (std::size_t i = 0; i < logs.size(); ++i) {
        const auto part = split.find(keys[i]);
        if (part == split.end()) continue;
        (part->second == Part::kTrain ? floor.train : floor.test).push_back(logs[i]);
        ++log_count;
      }
      if (!floor.train.empty() || !floor.test.empty()) site.floors.push_back(std::move(floor));
    }
    if (!site.floors.empty()) sites.push_back(std::move(site));
  }
  if (log_count == 0) {
    return core::fail(core::ErrorCode::kFileNotFound,
                      "no log found as <site>/<floor>/path_data_files/*.txt[.zst] that the split "
                      "names; check folder and split",
                      folder.string());
  }
  return sites;
}

/// The floor's plan if its files are there, else a bare floor of the size that is known.
core::Result<site::FloorDraft> read_floor(const FloorFolder& folder, const core::Bounds2& marked) {
  const fs::path geojson_path = folder.path / "geojson_map.json";
  const fs::path info_path = folder.path / "floor_info.json";
  if (fs::exists(geojson_path) && fs::exists(info_path)) {
    const auto geojson = core::read_file(geojson_path);
    const auto info = core::read_file(info_path);
    if (!geojson) return tl::unexpected(geojson.error());
    if (!info) return tl::unexpected(info.error());
    return site::parse_ilc_floor(*geojson, *info, folder.name, folder.path.string());
  }
  return site::bare_floor(folder.name, marked);
}

MarkedPath marks_of(const std::vector<sample::Sample>& samples) {
  MarkedPath path;
  for (const sample::Sample& sample : samples) {
    if (const auto* mark = std::get_if<sample::WaypointSample>(&sample)) {
      if (mark->position_m) path.push_back(*mark->position_m);
    }
  }
  return path;
}

core::Bounds2 bounds_of(const std::vector<MarkedPath>& paths) {
  constexpr double kMargin_m = 10.0;
  core::Bounds2 bounds;
  bool first = true;
  for (const MarkedPath& path : paths) {
    for (const core::Vector2& mark : path) {
      bounds.min_m = first ? mark : bounds.min_m.cwiseMin(mark);
      bounds.max_m = first ? mark : bounds.max_m.cwiseMax(mark);
      first = false;
    }
  }
  bounds.min_m.array() -= kMargin_m;
  bounds.max_m.array() += kMargin_m;
  return bounds;
}

/// Builds one site from its training logs.
class SiteLoader {
 public:
  SiteLoader(SiteFolder& folder, const DatasetContext& context)
      : folder_(folder), context_(context) {}

  core::Result<std::shared_ptr<const pipeline::Model>> load(const std::function<void()>& advance) {
    std::vector<survey::SurveyedRecording> recordings;
    for (std::size_t i = 0; i < folder_.floors.size(); ++i) {
      if (auto read = read_training(i, recordings, advance); !read) {
        return tl::unexpected(read.error());
      }
    }
    auto parts = site_parts();
    if (!parts) return tl::unexpected(parts.error());
    survey::MapBuilder builder(*std::move(parts), context_.options.survey_options());
    for (survey::SurveyedRecording& recording : recordings) {
      builder.add(recording);
      recording.samples.clear();
      recording.samples.shrink_to_fit();
    }
    auto surveyed = builder.build();
    if (!surveyed) return tl::unexpected(surveyed.error());
    return pipeline::Model::create(std::make_shared<site::Site>(std::move(surveyed->parts)),
                                   context_.options);
  }

 private:
  core::Result<void> read_training(std::size_t floor_index,
                                   std::vector<survey::SurveyedRecording>& recordings,
                                   const std::function<void()>& advance) {
    FloorFolder& floor = folder_.floors[floor_index];
    for (const fs::path& path : floor.train) {
      auto recording = log::load_recording(path);
      if (!recording) return tl::unexpected(recording.error());
      floor.train_paths.push_back(marks_of(recording->samples));
      recordings.push_back({recording_name(path), std::move(recording->samples),
                            core::FloorId{static_cast<std::uint16_t>(floor_index)}});
      advance();
    }
    return {};
  }

  core::Result<site::SiteParts> site_parts() const {
    std::vector<site::FloorDraft> drafts;
    for (const FloorFolder& floor : folder_.floors) {
      auto draft = read_floor(floor, bounds_of(floor.train_paths));
      if (!draft) return tl::unexpected(draft.error());
      drafts.push_back(*std::move(draft));
    }
    site::SiteParts parts;
    parts.name = folder_.name;
    auto floors = site::join_floors(std::move(drafts), parts.origin);
    if (!floors) return tl::unexpected(floors.error());
    parts.floors = *std::move(floors);
    return parts;
  }

  SiteFolder& folder_;
  const DatasetContext& context_;
};

core::Result<void> add_tests(const SiteFolder& site,
                             const std::shared_ptr<const pipeline::Model>& model,
                             Dataset& dataset) {
  for (std::size_t i = 0; i < site.floors.size(); ++i) {
    const FloorFolder& floor = site.floors[i];
    const core::FloorId id{static_cast<std::uint16_t>(i)};
    const bool mapped = is_mapped(*model->site(), id);
    for (const fs::path& path : floor.test) {
      if (!mapped) {
        return core::fail(core::ErrorCode::kMapMissing,
                          "its floor " + site.name + "/" + floor.name +
                              " has no radio map; put some of the floor's traces into train",
                          path.string());
      }
      TestCase test;
      test.name = recording_name(path);
      test.group = site.name + "/" + floor.name;
      test.model = model;
      test.floor = id;
      test.load = [path, model, id] { return load_marked_log(path, *model->site(), id); };
      const auto recording = test.load();
      if (!recording) return tl::unexpected(recording.error());
      test.covered = is_covered(marks_of(recording->samples), floor.train_paths);
      dataset.tests.push_back(std::move(test));
    }
  }
  return {};
}

}  // namespace

core::Result<Dataset> load_ilc_dataset(const fs::path& folder,
                                       const std::optional<fs::path>& split_path,
                                       const DatasetContext& context) {
  std::optional<Split> split;
  if (split_path) {
    auto read = read_split(*split_path, {"site", "floor", "trace"});
    if (!read) return tl::unexpected(read.error());
    split = *std::move(read);
  }
  auto sites = list_folders(folder, split);
  if (!sites) return tl::unexpected(sites.error());
  std::size_t total = 0;
  for (const SiteFolder& site : *sites) {
    for (const FloorFolder& floor : site.floors) total += floor.train.size();
  }

  Dataset dataset{"ilc", true, {}};
  std::size_t done = 0;
  for (SiteFolder& site : *sites) {
    auto model = SiteLoader(site, context).load([&] {
      if (context.progress) context.progress(++done, total);
    });
    if (!model) return tl::unexpected(model.error());
    if (auto added = add_tests(site, *model, dataset); !added) {
      return tl::unexpected(added.error());
    }
  }
  return dataset;
}

}  // namespace waylode::cli
