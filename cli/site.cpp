// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/site.hpp"

#include <memory>

#include "command.hpp"
#include "config_file.hpp"
#include "ilc_floor.hpp"
#include "output.hpp"
#include "progress_bar.hpp"
#include "site_report.hpp"
#include "waylode/core/file.hpp"
#include "waylode/log/log_reader.hpp"
#include "waylode/site/bundle.hpp"
#include "waylode/site/plan_geojson.hpp"
#include "waylode/survey/floors_from_marks.hpp"
#include "waylode/survey/map_builder.hpp"

namespace waylode::cli {
namespace {

struct BuildArguments {
  std::string out;
  std::string name;
  std::vector<std::string> plans;
  std::vector<std::string> ilc_floors;
  std::vector<std::string> logs;
  std::string floor;
  std::optional<std::string> report;
  std::optional<std::string> config;
  bool json = false;
};

core::Result<site::FloorDraft> read_plan(const std::string& path) {
  const auto text = core::read_file(path);
  if (!text) return tl::unexpected(text.error());
  return site::parse_plan(*text, path);
}

core::Result<std::vector<site::FloorDraft>> read_floors(const BuildArguments& arguments) {
  std::vector<site::FloorDraft> drafts;
  const auto take = [&](core::Result<site::FloorDraft> draft,
                        const std::string& path) -> core::Result<void> {
    if (!draft) return tl::unexpected(draft.error());
    for (const std::string& note : draft->notes) print_note(path + ": " + note);
    drafts.push_back(*std::move(draft));
    return {};
  };
  for (const std::string& path : arguments.plans) {
    if (auto taken = take(read_plan(path), path); !taken) return tl::unexpected(taken.error());
  }
  for (const std::string& path : arguments.ilc_floors) {
    if (auto taken = take(read_ilc_floor(path), path); !taken) {
      return tl::unexpected(taken.error());
    }
  }
  return drafts;
}

/// Marks that name no floor take the log's, else the one told on the command line.
void name_floors(log::Recording& recording, const std::string& fallback) {
  const std::string& header = recording.report.info.floor;
  for (sample::Sample& sample : recording.samples) {
    auto* mark = std::get_if<sample::WaypointSample>(&sample);
    if (mark != nullptr && mark->floor.empty()) mark->floor = header.empty() ? fallback : header;
  }
}

core::Result<std::vector<survey::SurveyedRecording>> read_logs(const BuildArguments& arguments) {
  std::vector<survey::SurveyedRecording> recordings;
  ProgressBar bar("reading logs");
  for (const std::string& path : arguments.logs) {
    auto recording = log::load_recording(path);
    if (!recording) return tl::unexpected(recording.error());
    name_floors(*recording, arguments.floor);
    recordings.push_back({path, std::move(recording->samples), std::nullopt});
    bar.show(recordings.size(), arguments.logs.size());
  }
  return recordings;
}

core::Result<site::SiteParts> make_parts(const BuildArguments& arguments,
                                         std::span<const survey::SurveyedRecording> recordings) {
  auto drafts = read_floors(arguments);
  if (!drafts) return tl::unexpected(drafts.error());
  if (drafts->empty()) return survey::floors_from_marks(arguments.name, recordings);
  site::SiteParts parts;
  parts.name = arguments.name;
  auto floors = site::join_floors(*std::move(drafts), parts.origin);
  if (!floors) return tl::unexpected(floors.error());
  parts.floors = *std::move(floors);
  return parts;
}

core::Result<survey::SurveyedSite> survey_site(
    site::SiteParts parts, std::span<const survey::SurveyedRecording> recordings,
    const pipeline::Options& options) {
  if (recordings.empty()) return survey::SurveyedSite{std::move(parts), {}};
  survey::MapBuilder builder(std::move(parts), options.survey_options());
  ProgressBar bar("mapping");
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    builder.add(recordings[i]);
    bar.show(i + 1, recordings.size());
  }
  return builder.build();
}

core::Result<void> build(const BuildArguments& arguments) {
  if (auto replaceable = check_replaceable(arguments.out); !replaceable) return replaceable;
  if (arguments.logs.empty() && arguments.plans.empty() && arguments.ilc_floors.empty()) {
    return core::fail(core::ErrorCode::kInvalidArgument,
                      "nothing to build from; give surveyed logs, plans or both", "site build");
  }
  const auto options = load_options(arguments.config);
  if (!options) return tl::unexpected(options.error());
  const auto recordings = read_logs(arguments);
  if (!recordings) return tl::unexpected(recordings.error());
  auto parts = make_parts(arguments, *recordings);
  if (!parts) return tl::unexpected(parts.error());
  const auto surveyed = survey_site(*std::move(parts), *recordings, *options);
  if (!surveyed) return tl::unexpected(surveyed.error());
  const auto version = site::write_bundle(surveyed->parts, arguments.out);
  if (!version) return tl::unexpected(version.error());

  const std::string json =
      quality_to_json(arguments.name, version_text(*version), surveyed->quality);
  if (arguments.report) {
    if (auto written = write_output(arguments.report, json); !written) return written;
  }
  print(arguments.json ? json
                       : "wrote " + arguments.out + ", version " + version_text(*version) + "\n" +
                             quality_to_text(surveyed->quality));
  return {};
}

void add_build(Verb& site) {
  const auto arguments = std::make_shared<BuildArguments>();
  Verb verb = site.verb("build", "Make a site bundle from floor plans and surveyed logs");
  verb.examples(
      "  waylode site build office.wlsite --name office --plan F1.geojson survey-*.mcap\n"
      "  waylode site build mall.wlsite --name mall --ilc-floor ilc/site1/F1 "
      "ilc/site1/F1/path_data_files/*");
  verb.argument("OUT", arguments->out, "The bundle to write, usually named *.wlsite").required();
  verb.argument("LOG", arguments->logs, "Logs with marks of where the surveyor was");
  verb.argument("--name", arguments->name, "The site's name").required();
  verb.argument("--plan", arguments->plans, "A floor's plan (GeoJSON in floor metres); repeatable");
  verb.argument("--ilc-floor", arguments->ilc_floors,
                "A floor's folder with floor_info.json and geojson_map.json; repeatable");
  verb.argument("--floor", arguments->floor, "Floor of the marks in logs that name none");
  verb.argument("--report", arguments->report, "Write the quality report as JSON to this file");
  verb.argument("--json", arguments->json, "Print the quality report as JSON");
  verb.argument("--config", arguments->config, kConfigHelp);
  verb.run([arguments] { return build(*arguments); });
}

void add_show(Verb& site) {
  struct ShowArguments {
    std::string site;
    bool json = false;
  };
  const auto arguments = std::make_shared<ShowArguments>();
  Verb verb = site.verb("show", "Tell what a site bundle holds");
  verb.examples("  waylode site show office.wlsite");
  verb.argument("SITE", arguments->site, "The bundle").required();
  verb.argument("--json", arguments->json, "Print JSON");
  verb.run([arguments]() -> core::Result<void> {
    const auto loaded = site::load_bundle(arguments->site);
    if (!loaded) return tl::unexpected(loaded.error());
    print(arguments->json ? site_to_json(**loaded) : site_to_text(**loaded));
    return {};
  });
}

}  // namespace

void add_site(Verb& root) {
  Verb site =
      root.verb("site", "Build or show a site: floors, frames and maps; or draw a plan from walks");
  add_build(site);
  add_show(site);
  add_site_from_walks(site);
}

}  // namespace waylode::cli
