// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>

#include "command.hpp"
#include "config_file.hpp"
#include "output.hpp"
#include "waylode/log/log_reader.hpp"
#include "waylode/pipeline/options.hpp"
#include "waylode/site/plan_geojson.hpp"
#include "waylode/structure/structure_adjuster.hpp"
#include "waylode/structure/structure_plan.hpp"
#include "waylode/structure/walk_from_samples.hpp"

namespace waylode::cli {
namespace {

struct Arguments {
  std::vector<std::string> logs;
  std::vector<std::string> landmarks;
  std::vector<std::string> known_distances;
  std::string floor = "F1";
  double width_m = 2.0;
  std::string out;
  std::optional<std::string> config;
};

/// "A:B=20.0"; names may hold "=" but no colon.
core::Result<structure::KnownDistance> parse_distance(const std::string& text) {
  const auto colon = text.find(':');
  const auto equals = text.rfind('=');
  structure::KnownDistance known;
  bool is_number = false;
  if (equals != std::string::npos) {
    const char* end = text.data() + text.size();
    const auto [stop, problem] = std::from_chars(text.data() + equals + 1, end, known.metres);
    is_number = problem == std::errc{} && stop == end && std::isfinite(known.metres);
  }
  if (!is_number || colon == std::string::npos || colon == 0 || colon + 1 >= equals) {
    return core::fail(core::ErrorCode::kInvalidArgument,
                      "must be LANDMARK:LANDMARK=METRES, such as Door:Lift=20.5",
                      "--known-distance " + text);
  }
  known.from = text.substr(0, colon);
  known.to = text.substr(colon + 1, equals - colon - 1);
  return known;
}

/// Marks by the names given, in order; else by where they say to be, to the decimetre.
std::vector<structure::LandmarkMark> marks_of(const log::Recording& recording,
                                              const std::vector<std::string>& names) {
  std::vector<structure::LandmarkMark> marks;
  std::size_t index = 0;
  for (const sample::Sample& sample : recording.samples) {
    const auto* mark = std::get_if<sample::WaypointSample>(&sample);
    if (mark == nullptr) continue;
    std::string name;
    if (index < names.size()) {
      name = names[index];
    } else if (names.empty() && mark->position_m) {
      char text[64];
      std::snprintf(text, sizeof text, "%.1f,%.1f", mark->position_m->x(), mark->position_m->y());
      name = text;
    }
    ++index;
    if (!name.empty()) marks.push_back({mark->time, name});
  }
  return marks;
}

core::Result<structure::Survey> read_survey(const Arguments& arguments,
                                            const pipeline::Options& options) {
  structure::Survey survey;
  for (const std::string& text : arguments.known_distances) {
    auto known = parse_distance(text);
    if (!known) return tl::unexpected(known.error());
    survey.known_distances.push_back(*std::move(known));
  }
  for (const std::string& path : arguments.logs) {
    const auto recording = log::load_recording(path);
    if (!recording) return tl::unexpected(recording.error());
    auto walk = structure::walk_from_samples(
        recording->samples, marks_of(*recording, arguments.landmarks), options.pdr, {});
    if (!walk) {
      core::Error error = walk.error();
      error.place = path + (error.place.empty() ? "" : ": " + error.place);
      return tl::unexpected(std::move(error));
    }
    survey.walks.push_back(*std::move(walk));
  }
  return survey;
}

void report(const structure::AdjustedStructure& structure, const Arguments& arguments) {
  for (const std::string& note : structure.notes) print_note(note);
  for (const structure::Closure& closure : structure.rejected) {
    print_note(arguments.logs[closure.second.walk] + ": stop " +
               std::to_string(closure.second.visit) + " is not at " +
               (closure.landmark.empty() ? "the place of its route" : closure.landmark) +
               "; not joined");
  }
  const auto used =
      std::ranges::count_if(structure.walks, [](const auto& walk) { return walk.used; });
  char text[160];
  std::snprintf(text, sizeof text,
                "wrote %zu corridors between %zu places from %td of %zu walks; scale %s\n",
                structure.edges.size(), structure.nodes.size(), used, structure.walks.size(),
                structure.scale_known ? "known" : "not known");
  print(text);
}

core::Result<void> from_walks(const Arguments& arguments) {
  if (auto replaceable = check_replaceable(arguments.out); !replaceable) return replaceable;
  const auto options = load_options(arguments.config);
  if (!options) return tl::unexpected(options.error());
  const auto survey = read_survey(arguments, *options);
  if (!survey) return tl::unexpected(survey.error());
  const auto structure = structure::StructureAdjuster({}).adjust(*survey);
  if (!structure) return tl::unexpected(structure.error());
  const auto draft = structure::to_plan(
      *structure, {.floor = arguments.floor, .corridor_width_m = arguments.width_m});
  if (!draft) return tl::unexpected(draft.error());
  for (const std::string& note : draft->notes) print_note(note);
  if (auto written = write_output(arguments.out, site::format_plan(*draft)); !written) {
    return written;
  }
  report(*structure, arguments);
  return {};
}

}  // namespace

void add_site_from_walks(Verb& site) {
  const auto arguments = std::make_shared<Arguments>();
  Verb verb = site.verb("from-walks", "Draw a floor's plan from recordings of walks");
  verb.examples(
      "  waylode site from-walks walk-*.mcap --landmarks Door,Lift,Kiosk,Stairs\n"
      "    --known-distance Door:Lift=20.5 --out F1.geojson");
  verb.argument("LOG", arguments->logs, "Logs of walks, marked at landmarks").required();
  verb.argument("--landmarks", arguments->landmarks,
                "Names of the marks of every log, in order; without it their positions are")
      .comma_separated();
  verb.argument("--known-distance", arguments->known_distances,
                "A distance between two landmarks, A:B=METRES; repeatable");
  verb.argument("--floor", arguments->floor, "The floor's name");
  verb.argument("--width", arguments->width_m, "Width of the corridors in metres")
      .in_range(0.2, 50.0);
  verb.argument("--out", arguments->out, "The plan to write (GeoJSON)").required();
  verb.argument("--config", arguments->config, kConfigHelp);
  verb.run([arguments] { return from_walks(*arguments); });
}

}  // namespace waylode::cli
