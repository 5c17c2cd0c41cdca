// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/experiment/room_walks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "waylode/core/assert.hpp"

namespace waylode::experiment {
namespace {

core::Vector2 truth_at(const std::vector<sim::TruthState>& truth, core::DeviceTime time) {
  const auto after = std::ranges::lower_bound(truth, time, {}, &sim::TruthState::time);
  if (after == truth.begin()) return truth.front().position_m;
  if (after == truth.end()) return truth.back().position_m;
  const auto before = std::prev(after);
  const double ratio =
      core::to_seconds(time - before->time) / core::to_seconds(after->time - before->time);
  return before->position_m + ratio * (after->position_m - before->position_m);
}

std::vector<core::DeviceTime> instants_of(const PaperRoom& room, double interval_s) {
  const auto is_scan = [](const sample::Sample& sample) {
    return std::holds_alternative<sample::WifiScan>(sample);
  };
  const auto first = std::ranges::find_if(room.walk.samples, is_scan);
  std::vector<core::DeviceTime> instants;
  if (first == room.walk.samples.end()) return instants;
  const core::DeviceTime end = room.walk.truth.back().time;
  for (core::DeviceTime time = sample::time_of(*first); time <= end;
       time += core::from_seconds(interval_s)) {
    instants.push_back(time);
  }
  return instants;
}

/// The scans taken standing before the walk, dated just before it, and the walk.
std::vector<sample::Sample> with_start_scans(const PaperRoom& room) {
  const core::DeviceTime begin = sample::time_of(room.walk.samples.front());
  std::vector<sample::Sample> samples;
  samples.reserve(room.start_scans.size() + room.walk.samples.size());
  for (std::size_t i = 0; i < room.start_scans.size(); ++i) {
    constexpr double kApart_s = 0.5;
    const double before_s = kApart_s * static_cast<double>(room.start_scans.size() - i);
    sample::WifiScan scan = room.start_scans[i];
    const core::Duration shift = begin - core::from_seconds(before_s) - scan.time;
    scan.time += shift;
    for (sample::WifiReading& reading : scan.readings) reading.last_seen += shift;
    samples.emplace_back(std::move(scan));
  }
  samples.insert(samples.end(), room.walk.samples.begin(), room.walk.samples.end());
  return samples;
}

/// One contender on one walk: its answers at the instants.
core::Result<std::vector<core::Fix>> answer(const std::shared_ptr<const pipeline::Model>& model,
                                            const Contender& contender, const PaperRoom& room,
                                            std::span<const sample::Sample> samples,
                                            const std::vector<core::DeviceTime>& instants) {
  const auto method = pipeline::find_method(contender.method);
  if (!method) return tl::unexpected(method.error());
  pipeline::SessionOptions options;
  options.known_floor = core::FloorId{0};
  if (contender.told_start) {
    constexpr double kStartSigma_m = 0.3;
    const sim::TruthState& begin = room.walk.truth.front();
    options.start =
        pipeline::StartPose{begin.time, core::FloorId{0}, begin.position_m, kStartSigma_m};
  }
  auto session = pipeline::Session::create(model, *method, options);
  if (!session) return tl::unexpected(session.error());
  return pipeline::replay(*session, *method, samples, instants);
}

Unit errors_of(const std::vector<core::Fix>& fixes, const PaperRoom& room, const site::Site& site) {
  const double charge_m = 0.5 * site.floors().front().bounds.diagonal_m();
  Unit errors;
  for (const core::Fix& fix : fixes) {
    errors.push_back(fix.belief
                         ? (fix.belief->position_m - truth_at(room.walk.truth, fix.time)).norm()
                         : charge_m);
  }
  return errors;
}

std::vector<core::Vector2> track_of(const std::vector<core::Fix>& fixes) {
  std::vector<core::Vector2> track;
  for (const core::Fix& fix : fixes) {
    if (fix.belief) track.push_back(fix.belief->position_m);
  }
  return track;
}

std::vector<double> pooled(const std::vector<Unit>& units) {
  std::vector<double> values;
  for (const Unit& unit : units) values.insert(values.end(), unit.begin(), unit.end());
  return values;
}

}  // namespace

const std::vector<Unit>& Trials::of(const std::string& label) const {
  const auto found = std::ranges::find(contenders, label, &Contender::label);
  WAYLODE_ASSERT(found != contenders.end());
  return errors_m[static_cast<std::size_t>(found - contenders.begin())];
}

core::Result<Trials> run_trials(const RoomMaker& make_room, std::uint64_t first_seed,
                                std::size_t walks, double interval_s,
                                const std::vector<Contender>& contenders,
                                const pipeline::Options& options,
                                const core::ProgressSink& progress) {
  Trials trials;
  trials.contenders = contenders;
  trials.errors_m.resize(contenders.size());
  trials.example_tracks.resize(contenders.size());
  for (std::size_t walk = 0; walk < walks; ++walk) {
    auto room = make_room(first_seed + walk);
    if (!room) return tl::unexpected(room.error());
    const auto site = std::make_shared<const site::Site>(std::move(room->site));
    const auto model = pipeline::Model::create(site, options);
    if (!model) return tl::unexpected(model.error());
    const std::vector<sample::Sample> samples = with_start_scans(*room);
    const std::vector<core::DeviceTime> instants = instants_of(*room, interval_s);
    for (std::size_t c = 0; c < contenders.size(); ++c) {
      const auto fixes = answer(*model, contenders[c], *room, samples, instants);
      if (!fixes) return tl::unexpected(fixes.error());
      trials.errors_m[c].push_back(errors_of(*fixes, *room, *site));
      if (walk == 0) trials.example_tracks[c] = track_of(*fixes);
    }
    if (walk == 0) {
      for (const core::DeviceTime instant : instants) {
        trials.example_truth.push_back(truth_at(room->walk.truth, instant));
      }
    }
    if (progress) progress(walk + 1, walks);
  }
  return trials;
}

Figure mean_figure(const Trials& trials, const std::string& label, const std::string& id,
                   const std::string& paper) {
  Figure figure;
  figure.id = id;
  figure.what = fmt::format("mean error, {}", label);
  figure.unit = std::string("m");
  figure.paper = paper;
  figure.ours = bootstrap(trials.of(label), mean_of);
  return figure;
}

Figure within_figure(const Trials& trials, const std::string& label, double limit_m,
                     const std::string& id, const std::string& paper) {
  Figure figure;
  figure.id = id;
  figure.what = fmt::format("{} within {:g} m", label, limit_m);
  figure.unit = std::string("%");
  figure.paper = paper;
  figure.ours = bootstrap(trials.of(label), [limit_m](std::span<const double> values) {
    return percent_within(values, limit_m);
  });
  return figure;
}

Figure reduction_figure(const Trials& trials, const std::string& label, const std::string& other,
                        const std::string& id, const std::string& paper) {
  Figure figure;
  figure.id = id;
  figure.what = fmt::format("{} below {}", label, other);
  figure.unit = std::string("%");
  figure.paper = paper;
  const std::vector<std::vector<Unit>> both = {trials.of(label), trials.of(other)};
  figure.ours = bootstrap(both, [](std::span<const std::vector<double>> values) {
    return 100.0 * (1.0 - mean_of(values[0]) / mean_of(values[1]));
  });
  return figure;
}

eval::LineChart error_curves(const Trials& trials, double most_m) {
  eval::LineChart chart;
  chart.title = "Error curves";
  chart.x = eval::axis_over(0.0, most_m, 8, "error at most (m)", "m");
  chart.y = eval::axis_over(0.0, 100.0, 5, "fixes (%)", "%");
  for (std::size_t c = 0; c < trials.contenders.size(); ++c) {
    const std::vector<double> values = pooled(trials.errors_m[c]);
    eval::Series series;
    series.method = c;
    series.name = trials.contenders[c].label;
    constexpr int kPoints = 100;
    for (int i = 0; i <= kPoints; ++i) {
      const double limit_m = most_m * i / kPoints;
      series.points.emplace_back(limit_m, percent_within(values, limit_m));
    }
    chart.series.push_back(std::move(series));
  }
  return chart;
}

eval::LineChart example_tracks(const Trials& trials) {
  eval::LineChart chart;
  chart.title = "The first walk";
  core::Vector2 least = core::Vector2::Constant(1e9);
  core::Vector2 most = core::Vector2::Constant(-1e9);
  const auto add = [&](std::size_t method, const std::string& name,
                       const std::vector<core::Vector2>& track) {
    eval::Series series;
    series.method = method;
    series.name = name;
    series.points = track;
    for (const core::Vector2& point : track) {
      least = least.cwiseMin(point);
      most = most.cwiseMax(point);
    }
    chart.series.push_back(std::move(series));
  };
  for (std::size_t c = 0; c < trials.contenders.size(); ++c) {
    add(c, trials.contenders[c].label, trials.example_tracks[c]);
  }
  add(trials.contenders.size(), "truth", trials.example_truth);
  chart.x = eval::axis_over(least.x(), most.x(), 8, "x (m)", "m");
  chart.y = eval::axis_over(least.y(), most.y(), 6, "y (m)", "m");
  chart.equal_scales = true;
  return chart;
}

eval::LineChart mean_bars(const Trials& trials) {
  eval::LineChart chart;
  chart.title = "Mean errors with 95 % intervals";
  double most_m = 0.0;
  for (std::size_t c = 0; c < trials.contenders.size(); ++c) {
    const Interval mean = bootstrap(trials.errors_m[c], mean_of);
    eval::Series series;
    series.method = c;
    series.name = trials.contenders[c].label;
    series.points = {{static_cast<double>(c + 1), mean.value}};
    series.half_widths = {0.5 * (mean.high - mean.low)};
    series.with_dots = true;
    series.with_line = false;
    chart.series.push_back(std::move(series));
    most_m = std::max(most_m, mean.high);
  }
  chart.x = {"method", "", static_cast<double>(trials.contenders.size() + 1), 1.0};
  chart.y = eval::axis_over(0.0, most_m, 6, "mean error (m)", "m");
  return chart;
}

}  // namespace waylode::experiment
