// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "reproduce_recordings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <thread>

#include "datasets/ilc_dataset.hpp"
#include "datasets/ipin_dataset.hpp"
#include "datasets/log_files.hpp"
#include "datasets/oxford_dataset.hpp"
#include "datasets/test_recording.hpp"
#include "datasets/uji_mag_dataset.hpp"
#include "progress_bar.hpp"
#include "run_evaluation.hpp"
#include "waylode/eval/metrics.hpp"
#include "waylode/experiment/bootstrap.hpp"
#include "waylode/experiment/step_length.hpp"

namespace waylode::cli {
namespace {

namespace fs = std::filesystem;
using experiment::Figure;
using experiment::Outcome;

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

Outcome absent(const std::string& paper, const std::string& title, const fs::path& path) {
  Outcome outcome;
  outcome.paper = paper;
  outcome.title = title;
  outcome.data = "recordings";
  outcome.notes.push_back("not run: " + path.string() +
                          " is not there; name the folder with --data");
  return outcome;
}

std::vector<experiment::Mark> marks_of(const std::vector<sample::Sample>& samples) {
  std::vector<experiment::Mark> marks;
  for (const sample::Sample& sample : samples) {
    const auto* mark = std::get_if<sample::WaypointSample>(&sample);
    if (mark != nullptr && mark->position_m) marks.push_back({mark->time, *mark->position_m});
  }
  return marks;
}

/// Every walk of the folder between its marks.
core::Result<Outcome> step_lengths(const fs::path& folder, const core::LogSink& log) {
  const auto paths = text_logs_below(folder);
  if (!paths) return tl::unexpected(paths.error());
  ProgressBar bar("step lengths");
  std::vector<experiment::MeasuredWalk> walks;
  std::size_t read = 0;
  for (const fs::path& path : *paths) {
    const auto recording = load_noted(path, log);
    if (!recording) return tl::unexpected(recording.error());
    auto walk = experiment::measure_walk(path.filename().string(), recording->samples,
                                         marks_of(recording->samples));
    if (walk) walks.push_back(*std::move(walk));
    bar.show(++read, paths->size());
  }
  auto outcome = experiment::step_length_outcome(walks);
  if (!outcome) return outcome;
  outcome->notes.push_back(fmt::format(
      "{} of {} recordings give a usable walk (at least 8 m, 8 steps, 0.35 to 1.0 m a step).",
      walks.size(), paths->size()));
  return outcome;
}

core::Result<Outcome> step_counting(const fs::path& archive, const core::LogSink& log) {
  const auto dataset = load_oxford_dataset(archive);
  if (!dataset) return tl::unexpected(dataset.error());
  for (const std::string& note : dataset->notes) {
    if (log) log(core::LogLevel::kInfo, "reproduce", note);
  }
  return experiment::step_counting_outcome(dataset->recordings);
}

core::Result<Outcome> magnetic_matching(const fs::path& archive) {
  const auto dataset = load_uji_mag_dataset(archive);
  if (!dataset) return tl::unexpected(dataset.error());
  return experiment::magnetic_matching_outcome(dataset->training, dataset->tests);
}

/// The one archive of a data set's folder; the folder itself when it is unpacked there.
fs::path archive_in(const fs::path& folder) {
  const auto entries = list_folder(folder);
  if (!entries) return folder;
  for (const fs::path& file : entries->files) {
    const std::string name = file.filename().string();
    if (name.find(".tar") != std::string::npos || name.ends_with(".zip")) return file;
  }
  return folder;
}

/// Runs a study whose data may not be there.
template <typename Study>
core::Result<void> add_study(const std::string& paper, const std::string& title,
                             const fs::path& folder, const Study& study,
                             std::vector<Outcome>& outcomes) {
  if (!is_there(folder)) {
    outcomes.push_back(absent(paper, title, folder));
    return {};
  }
  auto outcome = study();
  if (!outcome) return tl::unexpected(outcome.error());
  outcomes.push_back(*std::move(outcome));
  return {};
}

/// What a paper compares: its single methods and its fusion.
struct Comparison {
  std::string fused;
  std::vector<std::string> singles;
};

Comparison comparison_of(const std::string& paper) {
  if (paper == "wu2019") {
    return {"wu2019", {"wknn+radio=region_wknn", "wu2019+stride=improved+fusion=dead_reckoning"}};
  }
  if (paper == "zhou2016") {
    return {"zhou2016", {"wknn+radio=window_knn", "zhou2016+magnetic=none+fusion=dead_reckoning"}};
  }
  return {"zhao2019", {"wknn+radio=knn", "zhao2019+radio=knn+fusion=dead_reckoning"}};
}

/// One unit a recording: the errors of its scored truths.
std::vector<experiment::Unit> errors_by_recording(const std::vector<eval::EvaluatedTrack>& tracks,
                                                  const std::string& method) {
  std::vector<experiment::Unit> units;
  for (const eval::EvaluatedTrack& track : tracks) {
    if (track.method != method) continue;
    experiment::Unit unit;
    for (const eval::PointError& error : eval::track_errors(track)) {
      unit.push_back(error.horizontal_m);
    }
    units.push_back(std::move(unit));
  }
  return units;
}

eval::LineChart error_curves(const std::vector<std::string>& methods,
                             const std::vector<std::vector<experiment::Unit>>& errors) {
  eval::LineChart chart;
  chart.title = "Error curves";
  chart.x = eval::axis_over(0.0, 20.0, 10, "error at most (m)", "m");
  chart.y = eval::axis_over(0.0, 100.0, 5, "fixes (%)", "%");
  for (std::size_t m = 0; m < methods.size(); ++m) {
    std::vector<double> values;
    for (const experiment::Unit& unit : errors[m]) {
      values.insert(values.end(), unit.begin(), unit.end());
    }
    eval::Series series;
    series.method = m;
    series.name = methods[m];
    for (double limit_m = 0.0; limit_m <= 20.0; limit_m += 0.25) {
      series.points.emplace_back(limit_m, experiment::percent_within(values, limit_m));
    }
    chart.series.push_back(std::move(series));
  }
  return chart;
}

core::Result<Outcome> compare_on(const Dataset& dataset, const std::string& paper,
                                 const std::string& experiment_id, bool floor_known) {
  const Comparison comparison = comparison_of(paper);
  std::vector<std::string> names = comparison.singles;
  names.push_back(comparison.fused);
  EvaluationOptions options;
  options.floor_known = floor_known;
  options.threads = std::max(1U, std::thread::hardware_concurrency());
  for (const std::string& name : names) {
    const auto method = pipeline::find_method(name);
    if (!method) return tl::unexpected(method.error());
    options.methods.push_back(*method);
  }
  ProgressBar bar(paper + " on " + dataset.name);
  const auto tracks = run_evaluation(dataset, options, bar.sink());
  if (!tracks) return tl::unexpected(tracks.error());

  Outcome outcome;
  outcome.paper = paper;
  outcome.title = "Fusion on real walks, " + dataset.name;
  outcome.data = fmt::format("{} test recordings of {}, floor {}, held-out part of a fixed split",
                             dataset.tests.size(), dataset.name, floor_known ? "told" : "not told");
  std::vector<std::vector<experiment::Unit>> errors;
  for (const std::string& name : names) {
    errors.push_back(errors_by_recording(*tracks, name));
    Figure figure;
    figure.id = experiment_id;
    figure.what = "mean error, " + name;
    figure.unit = std::string("m");
    figure.ours = experiment::bootstrap(errors.back(), experiment::mean_of);
    outcome.figures.push_back(figure);
  }
  Figure gain;
  gain.id = experiment_id;
  gain.what = "best single method's mean less the fused one's";
  gain.unit = std::string("m");
  gain.ours = experiment::bootstrap(errors, [](std::span<const std::vector<double>> values) {
    return std::min(experiment::mean_of(values[0]), experiment::mean_of(values[1])) -
           experiment::mean_of(values[2]);
  });
  // The specification asks it of Wu's method alone.
  if (paper == "wu2019") gain.bar = experiment::Bar{experiment::Bar::Sense::kAtLeast, 0.0};
  gain.note =
      "fused at most as far off as the better single method; its dead reckoning starts at the "
      "first scan";
  outcome.figures.push_back(gain);
  outcome.charts.push_back(error_curves(names, errors));
  return outcome;
}

core::Result<void> add_fusion(const std::string& paper, const fs::path& data,
                              const pipeline::Options& options, const core::LogSink& log,
                              std::vector<Outcome>& outcomes) {
  const std::string id = paper == "wu2019" ? "W-X4" : paper == "zhou2016" ? "Z-X4" : "R-X4";
  const DatasetContext context{options, {}, log};
  const auto on = [&](const core::Result<Dataset>& dataset,
                      bool floor_known) -> core::Result<Outcome> {
    if (!dataset) return tl::unexpected(dataset.error());
    return compare_on(*dataset, paper, id, floor_known);
  };
  const auto mall = add_study(
      paper, "Fusion on real walks, ILC", data / "ilc",
      [&] { return on(load_ilc_dataset(data / "ilc", std::nullopt, context), true); }, outcomes);
  if (!mall) return mall;
  return add_study(
      paper, "Fusion on real walks, IPIN", data / "ipin2023",
      [&] { return on(load_ipin_dataset(data / "ipin2023", std::nullopt, context), false); },
      outcomes);
}

}  // namespace

core::Result<std::vector<Outcome>> reproduce_on_recordings(const std::string& paper,
                                                           const fs::path& data,
                                                           const pipeline::Options& options,
                                                           const core::LogSink& log) {
  std::vector<Outcome> outcomes;
  core::Result<void> added;
  if (paper == "zhao2019") {
    added = add_study(
        paper, "Step-length models on real walks", data / "ilc",
        [&] { return step_lengths(data / "ilc", log); }, outcomes);
  } else if (paper == "zhou2016") {
    added = add_study(
        paper, "Magnetic matching on real walks", data / "uji-mag",
        [&] { return magnetic_matching(archive_in(data / "uji-mag")); }, outcomes);
  } else if (paper == "zhong2017") {
    added = add_study(
        paper, "Step counting on real walks", data / "oxford-steps",
        [&] { return step_counting(archive_in(data / "oxford-steps"), log); }, outcomes);
  }
  if (!added) return tl::unexpected(added.error());
  if (paper != "zhong2017") {
    if (auto fused = add_fusion(paper, data, options, log, outcomes); !fused) {
      return tl::unexpected(fused.error());
    }
  }
  return outcomes;
}

}  // namespace waylode::cli
