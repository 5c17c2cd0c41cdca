// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>

#include "command.hpp"
#include "config_file.hpp"
#include "fix_format.hpp"
#include "output.hpp"
#include "waylode/log/log_reader.hpp"
#include "waylode/pipeline/session.hpp"
#include "waylode/site/bundle.hpp"

namespace waylode::cli {
namespace {

struct Arguments {
  std::string log;
  std::string site;
  std::string method = "fused";
  std::optional<std::string> floor;
  std::optional<std::string> start;
  double rate_hz = 1.0;
  std::string format = "geojson";
  std::optional<std::string> out;
  std::optional<std::string> config;
};

core::Result<core::FloorId> find_floor(const site::Site& site, const std::string& name) {
  if (const auto floor = site.find_floor(name)) return *floor;
  std::string known;
  for (const site::Floor& floor : site.floors()) known += (known.empty() ? "" : ", ") + floor.name;
  return core::fail(core::ErrorCode::kFloorUnknown, "no floor " + name + "; the site has " + known,
                    site.name());
}

std::optional<double> parse_number(std::string_view text) {
  double number = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (problem != std::errc{} || end != text.data() + text.size() || !std::isfinite(number)) {
    return std::nullopt;
  }
  return number;
}

/// "FLOOR,X,Y"; the floor's name may hold commas.
core::Result<pipeline::StartPose> parse_start(const site::Site& site, const std::string& text,
                                              core::DeviceTime time) {
  const auto y_comma = text.rfind(',');
  const auto x_comma = y_comma == 0 ? std::string::npos : text.rfind(',', y_comma - 1);
  if (y_comma == std::string::npos || x_comma == std::string::npos) {
    return core::fail(core::ErrorCode::kInvalidArgument, "must be FLOOR,X,Y, such as F1,12.5,30",
                      "--start " + text);
  }
  const std::string_view all = text;
  const auto x_m = parse_number(all.substr(x_comma + 1, y_comma - x_comma - 1));
  const auto y_m = parse_number(all.substr(y_comma + 1));
  if (!x_m || !y_m) {
    return core::fail(core::ErrorCode::kInvalidArgument, "X and Y must be metres on the floor",
                      "--start " + text);
  }
  const auto floor = find_floor(site, text.substr(0, x_comma));
  if (!floor) return tl::unexpected(floor.error());
  return pipeline::StartPose{time, *floor, {*x_m, *y_m}};
}

core::Result<pipeline::SessionOptions> session_options(const Arguments& arguments,
                                                       const site::Site& site,
                                                       core::DeviceTime begin) {
  pipeline::SessionOptions options;
  if (arguments.floor) {
    const auto floor = find_floor(site, *arguments.floor);
    if (!floor) return tl::unexpected(floor.error());
    options.known_floor = *floor;
  }
  if (arguments.start) {
    const auto start = parse_start(site, *arguments.start, begin);
    if (!start) return tl::unexpected(start.error());
    options.start = *start;
  }
  return options;
}

bool is_usable(const sample::Sample& sample, const pipeline::Method& method,
               const site::RadioMap& map) {
  if (method.needs_start()) {
    return std::holds_alternative<sample::AccelerometerSample>(sample);
  }
  if (const auto* beacon = std::get_if<sample::BleReading>(&sample)) {
    return !map.postings_of(beacon->transmitter).empty();
  }
  const auto* scan = std::get_if<sample::WifiScan>(&sample);
  return scan != nullptr && !scan->readings.empty();
}

/// What the method cannot do without: motion for pdr, else Wi-Fi or a beacon that the map knows.
core::Result<void> check_records(const Arguments& arguments, const pipeline::Method& method,
                                 const site::RadioMap& map,
                                 std::span<const sample::Sample> samples) {
  if (std::ranges::any_of(
          samples, [&](const sample::Sample& sample) { return is_usable(sample, method, map); })) {
    return {};
  }
  return core::fail(core::ErrorCode::kLogLacksRecords,
                    method.needs_start()
                        ? "no accelerometer record, which method pdr needs; record motion sensors"
                        : "no Wi-Fi record; record with Wi-Fi on, or use --method pdr with --start",
                    arguments.log);
}

/// Every 1 / rate_hz from the first sample to the last.
core::Result<std::vector<core::DeviceTime>> steady_instants(
    const Arguments& arguments, std::span<const sample::Sample> samples) {
  const core::DeviceTime begin = sample::time_of(samples.front());
  const double span_s = core::to_seconds(sample::time_of(samples.back()) - begin);
  constexpr double kMostInstants = 1e7;
  if (!(span_s * arguments.rate_hz < kMostInstants)) {
    return core::fail(core::ErrorCode::kInvalidArgument,
                      "the log's times span " + std::to_string(std::lround(span_s / 3600.0)) +
                          " hours, too many fixes; lower --rate-hz or mend the log's clock",
                      arguments.log);
  }
  const auto count = static_cast<std::size_t>(std::floor(span_s * arguments.rate_hz)) + 1;
  std::vector<core::DeviceTime> instants;
  instants.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    instants.push_back(begin + core::from_seconds(static_cast<double>(i) / arguments.rate_hz));
  }
  return instants;
}

core::Result<void> track(const Arguments& arguments) {
  const auto method = pipeline::find_method(arguments.method);
  if (!method) return tl::unexpected(method.error());
  const auto options = load_options(arguments.config);
  if (!options) return tl::unexpected(options.error());
  const auto site = site::load_bundle(arguments.site);
  if (!site) return tl::unexpected(site.error());
  const auto model = pipeline::Model::create(*site, *options);
  if (!model) return tl::unexpected(model.error());
  const auto recording = log::load_recording(arguments.log);
  if (!recording) return tl::unexpected(recording.error());
  const std::span<const sample::Sample> samples = recording->samples;
  if (auto enough = check_records(arguments, *method, (*site)->radio_map(), samples); !enough) {
    return enough;
  }

  const auto session_choices = session_options(arguments, **site, sample::time_of(samples.front()));
  if (!session_choices) return tl::unexpected(session_choices.error());
  auto session = pipeline::Session::create(*model, *method, *session_choices);
  if (!session) return tl::unexpected(session.error());
  const auto instants = steady_instants(arguments, samples);
  if (!instants) return tl::unexpected(instants.error());
  const auto fixes = pipeline::replay(*session, *method, samples, *instants);
  const auto format = arguments.format == "csv"    ? fixes_to_csv
                      : arguments.format == "json" ? fixes_to_json
                                                   : fixes_to_geojson;
  return write_output(arguments.out, format(**site, fixes));
}

}  // namespace

void add_track(Verb& root) {
  const auto arguments = std::make_shared<Arguments>();
  Verb verb = root.verb("track", "Find where the phone of a log was, at a steady rate");
  verb.examples(
      "  waylode track walk.mcap --site office.wlsite --out walk.geojson\n"
      "  waylode track walk.mcap --site office.wlsite --method pdr --start F1,12.5,30 --format "
      "csv");
  verb.argument("LOG", arguments->log, "The log of one phone").required();
  verb.argument("--site", arguments->site, "Site bundle made by `waylode site build`").required();
  verb.argument("--method", arguments->method, "See `waylode methods`");
  verb.argument("--floor", arguments->floor, "The floor, if it is known; then never doubted");
  verb.argument("--start", arguments->start, "FLOOR,X,Y where the walk begins (metres); for pdr");
  verb.argument("--rate-hz", arguments->rate_hz, "Fixes per second").in_range(0.001, 100.0);
  verb.argument("--format", arguments->format, "Of the output").one_of({"geojson", "csv", "json"});
  verb.argument("--out", arguments->out, "File to write; standard output without it");
  verb.argument("--config", arguments->config, kConfigHelp);
  verb.run([arguments] { return track(*arguments); });
}

}  // namespace waylode::cli
