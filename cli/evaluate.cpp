// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "command.hpp"
#include "config_file.hpp"
#include "datasets/ilc_dataset.hpp"
#include "datasets/ipin_dataset.hpp"
#include "datasets/mcap_dataset.hpp"
#include "datasets/uji_dataset.hpp"
#include "evaluate_arguments.hpp"
#include "output.hpp"
#include "progress_bar.hpp"
#include "run_evaluation.hpp"
#include "waylode/eval/report.hpp"
#include "waylode/site/bundle.hpp"

namespace waylode::cli {
namespace {

using Arguments = EvaluateArguments;
using Loader =
    std::function<core::Result<Dataset>(const Arguments& arguments, const DatasetContext& context)>;

core::Result<std::vector<pipeline::Method>> find_methods(const std::vector<std::string>& names) {
  std::vector<pipeline::Method> methods;
  for (const std::string& name : names) {
    if (std::ranges::count(names, name) > 1) {
      return core::fail(core::ErrorCode::kInvalidArgument,
                        "'" + name + "' is given twice; name each method once", "--methods");
    }
    const auto method = pipeline::find_method(name);
    if (!method) return tl::unexpected(method.error());
    methods.push_back(*method);
  }
  return methods;
}

core::Result<void> write_results(const Arguments& arguments, const eval::ReportOptions& report,
                                 const std::vector<eval::EvaluatedTrack>& tracks,
                                 const std::vector<eval::ResultRow>& rows,
                                 const eval::Findings& findings, bool with_covered) {
  if (arguments.out) {
    auto written = write_output(arguments.out, eval::to_json(report, rows, findings));
    if (!written) return written;
  }
  if (arguments.report) {
    auto written = write_output(arguments.report, eval::to_html(report, tracks, rows, findings));
    if (!written) return written;
  }
  if (arguments.chart) {
    auto written = write_output(
        arguments.chart,
        eval::scan_period_svg_file(findings.scan_periods, with_covered ? "covered" : "all"));
    if (!written) return written;
  }
  print(eval::to_text(rows) + eval::findings_text(findings));
  return {};
}

/// Before hours of work: could the results be kept?
core::Result<void> check_outputs(const Arguments& arguments) {
  if (auto sound = check_arguments(arguments); !sound) return sound;
  for (const auto& path : {arguments.out, arguments.report, arguments.chart}) {
    if (!path) continue;
    if (auto replaceable = check_replaceable(*path); !replaceable) return replaceable;
  }
  return {};
}

/// Notes are shown when the bar is gone, and not beside an error, which is one line.
core::Result<Dataset> load_dataset(const Arguments& arguments, const pipeline::Options& options,
                                   const Dealing& dealing, const Loader& load) {
  std::vector<std::string> notes;
  const core::LogSink log = [&](core::LogLevel /*level*/, std::string_view /*module*/,
                                std::string_view message) { notes.emplace_back(message); };
  core::Result<Dataset> dataset;
  {
    ProgressBar bar("reading and mapping");
    dataset = load(arguments, {options, bar.sink(), log, dealing});
  }
  if (dataset) std::ranges::for_each(notes, print_note);
  return dataset;
}

core::Result<std::vector<eval::EvaluatedTrack>> position(const std::string& task,
                                                         const Dataset& dataset,
                                                         const EvaluationOptions& options) {
  ProgressBar bar(task);
  return run_evaluation(dataset, options, bar.sink());
}

/// `rows` are those as recorded, which need no second run.
core::Result<std::vector<eval::ScanPeriodRows>> evaluate_periods(
    const Arguments& arguments, const Dataset& dataset, EvaluationOptions options,
    const std::vector<eval::ResultRow>& rows) {
  const auto periods_s = scan_periods_of(arguments);
  if (!periods_s) return tl::unexpected(periods_s.error());
  std::vector<eval::ScanPeriodRows> periods;
  options.with_path = false;
  for (const double period_s : *periods_s) {
    if (period_s == 0.0) {
      periods.push_back({period_s, rows});
      continue;
    }
    options.alteration.scan_period_s = period_s;
    const auto tracks = position("thinning scans", dataset, options);
    if (!tracks) return tl::unexpected(tracks.error());
    periods.push_back({period_s, eval::summarise(*tracks, dataset.has_covered)});
  }
  return periods;
}

/// What the table has no room for. `tracks` have paths when wrong starts are to be judged.
core::Result<eval::Findings> find(const Arguments& arguments, const Dataset& dataset,
                                  EvaluationOptions options,
                                  const std::vector<eval::EvaluatedTrack>& tracks,
                                  const std::vector<eval::ResultRow>& rows) {
  eval::Findings findings;
  findings.intervals = eval::bootstrap_means(tracks, dataset.has_covered, {});
  findings.methods = eval::find_details(tracks, dataset.has_covered);
  auto periods = evaluate_periods(arguments, dataset, options, rows);
  if (!periods) return tl::unexpected(periods.error());
  findings.scan_periods = *std::move(periods);
  if (arguments.wrong_start_m == 0.0) return findings;
  findings.wrong_start_rule.offset_m = arguments.wrong_start_m;
  options.wrong_start = WrongStart{arguments.wrong_start_m, findings.wrong_start_rule.sigma_m, 1};
  const auto perturbed = position("starting wrong", dataset, options);
  if (!perturbed) return tl::unexpected(perturbed.error());
  findings.wrong_starts =
      eval::judge_wrong_starts(*perturbed, tracks, dataset.has_covered, findings.wrong_start_rule);
  return findings;
}

core::Result<void> evaluate(const Arguments& arguments, const std::string& command_line,
                            const Loader& load) {
  if (auto keepable = check_outputs(arguments); !keepable) return keepable;
  auto methods = find_methods(arguments.methods);
  if (!methods) return tl::unexpected(methods.error());
  auto options = load_options(arguments.config);
  if (!options) return tl::unexpected(options.error());

  const auto dealing = dealing_of(arguments);
  if (!dealing) return tl::unexpected(dealing.error());

  auto dataset = load_dataset(arguments, *options, *dealing, load);
  if (!dataset) return tl::unexpected(dataset.error());
  if (dataset->tests.empty()) {
    return core::fail(core::ErrorCode::kInvalidArgument,
                      "the split leaves no recording to test; mark some as test", arguments.first);
  }
  EvaluationOptions evaluation{*std::move(methods), arguments.floor == "known",
                               std::max(1U, std::thread::hardware_concurrency()),
                               alteration_of(arguments), arguments.wrong_start_m > 0.0};
  const auto tracks = position("positioning", *dataset, evaluation);
  if (!tracks) return tl::unexpected(tracks.error());
  const std::vector<eval::ResultRow> rows = eval::summarise(*tracks, dataset->has_covered);
  auto findings = find(arguments, *dataset, evaluation, *tracks, rows);
  if (!findings) return tl::unexpected(findings.error());
  return write_results(arguments, {"Evaluation on " + dataset->name, dataset->name, command_line},
                       *tracks, rows, *findings, dataset->has_covered);
}

void add_common(Verb& verb, const std::shared_ptr<Arguments>& arguments, const char* default_floor,
                Loader load) {
  arguments->floor = default_floor;
  add_common_arguments(verb, *arguments);
  verb.run([arguments, load = std::move(load), &context = verb.context()] {
    return evaluate(*arguments, context.command_line, load);
  });
}

std::optional<std::filesystem::path> split_path(const Arguments& arguments) {
  if (!arguments.split) return std::nullopt;
  return std::filesystem::path(*arguments.split);
}

void add_ilc(Verb& evaluation) {
  const auto arguments = std::make_shared<Arguments>();
  Verb verb = evaluation.verb("ilc", "Indoor Location Competition folders");
  verb.examples("  waylode evaluate ilc data/ilc --methods wknn,fused,smoothed --out ilc.json");
  verb.argument("DIR", arguments->first, "Holds <site>/<floor>/path_data_files/*.txt[.zst]")
      .required();
  verb.argument("--split", arguments->split,
                "CSV with site,floor,trace,split (train|test); a seeded 75/25 split without it");
  add_split_arguments(verb, *arguments);
  add_common(verb, arguments, "known", [](const Arguments& given, const DatasetContext& context) {
    return load_ilc_dataset(given.first, split_path(given), context);
  });
}

void add_ipin(Verb& evaluation) {
  const auto arguments = std::make_shared<Arguments>();
  Verb verb = evaluation.verb("ipin", "GetSensorData logs, as in the IPIN competitions");
  verb.examples("  waylode evaluate ipin data/ipin2023 --split routes.csv --out ipin.json");
  verb.argument("DIR", arguments->first, "Searched with all its folders for *.txt[.zst]")
      .required();
  verb.argument("--split", arguments->split,
                "CSV with log,split (train|test); a seeded 75/25 split without it");
  add_split_arguments(verb, *arguments);
  add_common(verb, arguments, "unknown", [](const Arguments& given, const DatasetContext& context) {
    return load_ipin_dataset(given.first, split_path(given), context);
  });
}

void add_uji(Verb& evaluation) {
  const auto arguments = std::make_shared<Arguments>();
  arguments->methods = {"wknn"};
  Verb verb = evaluation.verb("uji", "UJIIndoorLoc tables");
  verb.examples("  waylode evaluate uji trainingData.csv validationData.csv --out uji.json");
  verb.argument("TRAIN", arguments->first, "Surveyed fingerprints, CSV or CSV.zst").required();
  verb.argument("VALIDATION", arguments->second, "Fingerprints to place").required();
  add_common(verb, arguments, "unknown", [](const Arguments& given, const DatasetContext& context) {
    return load_uji_dataset(given.first, given.second, context);
  });
}

void add_mcap(Verb& evaluation) {
  const auto arguments = std::make_shared<Arguments>();
  Verb verb = evaluation.verb("mcap", "Logs with marks on a site that is already built");
  verb.examples("  waylode evaluate mcap office.wlsite walk-*.mcap --report report.html");
  verb.argument("SITE", arguments->first, "Site bundle made by `waylode site build`").required();
  verb.argument("LOG", arguments->logs, "Logs of any format that `waylode inspect` reads")
      .required();
  add_common(verb, arguments, "unknown",
             [](const Arguments& given, const DatasetContext& context) -> core::Result<Dataset> {
               auto site = site::load_bundle(given.first);
               if (!site) return tl::unexpected(site.error());
               return load_log_dataset(*site, {given.logs.begin(), given.logs.end()}, context);
             });
}

}  // namespace

void add_evaluate(Verb& root) {
  Verb evaluation = root.verb("evaluate", "Compare methods with the truth on recordings");
  add_ilc(evaluation);
  add_ipin(evaluation);
  add_uji(evaluation);
  add_mcap(evaluation);
}

}  // namespace waylode::cli
