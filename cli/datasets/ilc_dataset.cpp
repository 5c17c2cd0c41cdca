// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "datasets/ilc_dataset.hpp"

#include <algorithm>
#include <set>
#include <system_error>

#include "datasets/coverage.hpp"
#include "datasets/log_files.hpp"
#include "datasets/split.hpp"
#include "datasets/test_recording.hpp"
#include "ilc_floor.hpp"
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
  std::vector<fs::path> unlabelled;
  std::vector<MarkedPath> train_paths;
};

struct SiteFolder {
  std::string name;
  fs::path path;
  std::vector<FloorFolder> floors;
};

std::vector<fs::path>& logs_of(FloorFolder& floor, Part part) {
  if (part == Part::kTrain) return floor.train;
  return part == Part::kTest ? floor.test : floor.unlabelled;
}

Split of_keys(const Split& split, const std::vector<std::string>& keys) {
  Split chosen;
  for (const std::string& key : keys) {
    if (const auto entry = split.find(key); entry != split.end()) chosen.insert(*entry);
  }
  return chosen;
}

/// Deals the logs of one floor into train and test; keys that have a log go into `found`.
core::Result<FloorFolder> read_floor_folder(const std::string& site_name, const fs::path& path,
                                            const std::optional<Split>& given_split,
                                            const Dealing& dealing, std::set<std::string>& found) {
  FloorFolder floor{path.filename().string(), path, {}, {}, {}, {}};
  const auto entries = list_folder(path / "path_data_files");
  if (!entries) {
    const bool absent = entries.error().code == core::ErrorCode::kFileNotFound;
    return absent ? core::Result<FloorFolder>(floor) : tl::unexpected(entries.error());
  }
  const std::vector<fs::path> logs = text_logs(entries->files);
  std::vector<std::string> keys;
  for (const fs::path& log : logs) {
    keys.push_back(site_name + "/" + floor.name + "/" + recording_name(log));
  }
  Split split = given_split ? of_keys(*given_split, keys) : random_split(keys, dealing);
  keep_aside(split, dealing);
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const auto entry = split.find(keys[i]);
    if (entry == split.end()) continue;
    logs_of(floor, entry->second.part).push_back(logs[i]);
    found.insert(keys[i]);
  }
  return floor;
}

core::Result<SiteFolder> read_site_folder(const fs::path& path,
                                          const std::optional<Split>& given_split,
                                          const Dealing& dealing, std::set<std::string>& found) {
  SiteFolder site{path.filename().string(), path, {}};
  const auto entries = list_folder(path);
  if (!entries) return tl::unexpected(entries.error());
  for (const fs::path& floor_path : entries->folders) {
    auto floor = read_floor_folder(site.name, floor_path, given_split, dealing, found);
    if (!floor) return tl::unexpected(floor.error());
    if (!floor->train.empty() || !floor->test.empty()) site.floors.push_back(*std::move(floor));
  }
  return site;
}

/// Finds the sites that have tests, with all their floors and logs.
core::Result<std::vector<SiteFolder>> list_sites(const fs::path& folder,
                                                 const std::optional<Split>& given_split,
                                                 const Dealing& dealing,
                                                 std::set<std::string>& found) {
  const auto entries = list_folder(folder);
  if (!entries) return tl::unexpected(entries.error());
  std::vector<SiteFolder> sites;
  for (const fs::path& site_path : entries->folders) {
    auto site = read_site_folder(site_path, given_split, dealing, found);
    if (!site) return tl::unexpected(site.error());
    const bool tested = std::ranges::any_of(
        site->floors, [](const FloorFolder& floor) { return !floor.test.empty(); });
    if (tested) sites.push_back(*std::move(site));
  }
  if (found.empty()) {
    return core::fail(core::ErrorCode::kFileNotFound,
                      "no log found as <site>/<floor>/path_data_files/*.txt[.zst] that the split "
                      "names; check folder and split",
                      folder.string());
  }
  return sites;
}

tl::unexpected<core::Error> fail_unmapped(const SiteFolder& site, const FloorFolder& floor) {
  return core::fail(core::ErrorCode::kMapMissing,
                    "its floor " + site.name + "/" + floor.name +
                        " has no radio map; put some of the floor's traces into train",
                    floor.test.front().string());
}

/// Told before any log is read.
core::Result<void> check_trained(const std::vector<SiteFolder>& sites) {
  for (const SiteFolder& site : sites) {
    for (const FloorFolder& floor : site.floors) {
      if (!floor.test.empty() && floor.train.empty()) return fail_unmapped(site, floor);
    }
  }
  return {};
}

/// The floor's plan or size if its files are there, else a bare floor around the marks.
core::Result<site::FloorDraft> read_floor(const FloorFolder& folder, const core::Bounds2& marked) {
  std::error_code ignored;
  if (fs::exists(folder.path / "floor_info.json", ignored)) return read_ilc_floor(folder.path);
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
    if (!surveyed) {
      core::Error error = surveyed.error();
      if (error.place.empty()) error.place = folder_.path.string();
      return tl::unexpected(std::move(error));
    }
    return pipeline::Model::create(std::make_shared<site::Site>(std::move(surveyed->parts)),
                                   context_.options);
  }

 private:
  core::Result<void> read_training(std::size_t floor_index,
                                   std::vector<survey::SurveyedRecording>& recordings,
                                   const std::function<void()>& advance) {
    FloorFolder& floor = folder_.floors[floor_index];
    for (const fs::path& path : floor.train) {
      auto recording = load_noted(path, context_.log);
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

/// Adds one test, unless the log has no marks.
core::Result<void> add_test(const fs::path& path, const std::string& group,
                            const std::shared_ptr<const pipeline::Model>& model, core::FloorId id,
                            const std::vector<MarkedPath>& train_paths, const core::LogSink& log,
                            Dataset& dataset) {
  const auto recording = load_marked_log(path, *model->site(), id, log);
  if (!recording) return tl::unexpected(recording.error());
  if (recording->truths.empty()) {
    if (log) {
      log(core::LogLevel::kWarning, "evaluate",
          path.string() + ": no mark to judge by (TYPE_WAYPOINT); left out");
    }
    return {};
  }
  TestCase test;
  test.name = recording_name(path);
  test.group = group;
  test.covered = is_covered(marks_of(recording->samples), train_paths);
  test.model = model;
  test.floor = id;
  test.load = [path, model, id] { return load_marked_log(path, *model->site(), id, {}); };
  dataset.tests.push_back(std::move(test));
  return {};
}

core::Result<void> add_tests(const SiteFolder& site,
                             const std::shared_ptr<const pipeline::Model>& model,
                             const core::LogSink& log, Dataset& dataset) {
  for (std::size_t i = 0; i < site.floors.size(); ++i) {
    const FloorFolder& floor = site.floors[i];
    const core::FloorId id{static_cast<std::uint16_t>(i)};
    if (!floor.test.empty() && !is_mapped(*model->site(), id)) return fail_unmapped(site, floor);
    for (const fs::path& path : floor.test) {
      if (auto added = add_test(path, site.name + "/" + floor.name, model, id, floor.train_paths,
                                log, dataset);
          !added) {
        return added;
      }
    }
  }
  return {};
}

void add_unlabelled(const SiteFolder& site, const std::shared_ptr<const pipeline::Model>& model,
                    Dataset& dataset) {
  for (std::size_t i = 0; i < site.floors.size(); ++i) {
    const core::FloorId id{static_cast<std::uint16_t>(i)};
    for (const fs::path& path : site.floors[i].unlabelled) {
      dataset.unlabelled.push_back(
          {recording_name(path), site.name + "/" + site.floors[i].name, model,
           [path, model, id] { return load_unlabelled_log(path, *model->site(), id); }});
    }
  }
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
  std::set<std::string> found;
  auto sites = list_sites(folder, split, context.dealing, found);
  if (!sites) return tl::unexpected(sites.error());
  if (split) note_missing(*split, found, *split_path, context.log);
  if (auto trained = check_trained(*sites); !trained) return tl::unexpected(trained.error());
  std::size_t total = 0;
  for (const SiteFolder& site : *sites) {
    for (const FloorFolder& floor : site.floors) total += floor.train.size();
  }

  Dataset dataset{"ilc", true, {}, {}};
  std::size_t done = 0;
  for (SiteFolder& site : *sites) {
    auto model = SiteLoader(site, context).load([&] {
      if (context.progress) context.progress(++done, total);
    });
    if (!model) return tl::unexpected(model.error());
    if (auto added = add_tests(site, *model, context.log, dataset); !added) {
      return tl::unexpected(added.error());
    }
    add_unlabelled(site, *model, dataset);
  }
  return dataset;
}

}  // namespace waylode::cli
