// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "command.hpp"
#include "output.hpp"
#include "progress_bar.hpp"
#include "reproduce_recordings.hpp"
#include "waylode/experiment/outcome_report.hpp"
#include "waylode/experiment/papers.hpp"

namespace waylode::cli {
namespace {

struct Arguments {
  std::string paper;
  double seeds = 30;
  std::optional<std::uint64_t> first_seed;
  std::optional<std::string> preset;
  std::optional<std::string> data;
  std::optional<std::string> report;
  std::optional<std::string> out;
};

/// --data, else $WAYLODE_DATA; neither: simulation alone.
std::optional<std::string> data_folder(const Arguments& arguments) {
  if (arguments.data) return arguments.data;
  const char* folder = std::getenv("WAYLODE_DATA");
  return folder != nullptr && *folder != '\0' ? std::optional<std::string>(folder) : std::nullopt;
}

core::Result<std::vector<experiment::Outcome>> run_paper(const Arguments& arguments,
                                                         const std::string& paper,
                                                         const core::LogSink& log) {
  core::Result<std::vector<experiment::Outcome>> outcomes;
  {
    ProgressBar bar(paper + ", simulated");
    outcomes = experiment::run_simulated(paper,
                                         {static_cast<std::size_t>(arguments.seeds),
                                          arguments.first_seed.value_or(1), arguments.preset},
                                         bar.sink());
  }
  if (!outcomes) return outcomes;
  const auto folder = data_folder(arguments);
  // A preset is a simulated room: whoever names one wants no recordings.
  if (!folder || arguments.preset) return outcomes;
  auto recorded = reproduce_on_recordings(paper, *folder, log);
  if (!recorded) return recorded;
  std::ranges::move(*recorded, std::back_inserter(*outcomes));
  return outcomes;
}

core::Result<void> reproduce(const Arguments& arguments, const std::string& command_line) {
  const std::string report = arguments.report.value_or("reproduce-" + arguments.paper + ".html");
  for (const std::string& path : {report, arguments.out.value_or("")}) {
    if (path.empty()) continue;
    if (auto replaceable = check_replaceable(path); !replaceable) return replaceable;
  }
  std::vector<std::string> papers = {arguments.paper};
  if (arguments.paper == "all") {
    if (arguments.preset) {
      return core::fail(core::ErrorCode::kInvalidArgument,
                        "presets belong to one paper; name the paper",
                        "--preset " + *arguments.preset);
    }
    papers.clear();
    for (const experiment::Paper& paper : experiment::papers()) papers.emplace_back(paper.name);
  }
  std::vector<std::string> notes;
  const core::LogSink log = [&](core::LogLevel /*level*/, std::string_view /*module*/,
                                std::string_view message) { notes.emplace_back(message); };
  std::vector<experiment::Outcome> outcomes;
  for (const std::string& paper : papers) {
    auto ran = run_paper(arguments, paper, log);
    if (!ran) return tl::unexpected(ran.error());
    std::ranges::move(*ran, std::back_inserter(outcomes));
  }
  std::ranges::for_each(notes, print_note);
  if (auto written = write_output(report, experiment::to_html(outcomes, command_line)); !written) {
    return written;
  }
  if (arguments.out) {
    if (auto written = write_output(arguments.out, experiment::to_json(outcomes, command_line));
        !written) {
      return written;
    }
  }
  const experiment::Tally counted = experiment::tally(outcomes);
  print(experiment::to_text(outcomes));
  print(fmt::format("\nreport: {}\nbars reached {} of {}\n", report, counted.reached,
                    counted.judged));
  return {};
}

}  // namespace

void add_reproduce(Verb& root) {
  const auto arguments = std::make_shared<Arguments>();
  std::vector<std::string> names;
  std::string presets;
  for (const experiment::Paper& paper : experiment::papers()) {
    names.emplace_back(paper.name);
    presets += (presets.empty() ? "" : "; ") + std::string(paper.name) + ": " + paper.presets;
  }
  names.emplace_back("all");
  Verb verb = root.verb("reproduce", "Run the experiments of the four papers beside their figures");
  verb.examples(
      "  waylode reproduce wu2019 --seeds 30\n"
      "  waylode reproduce all --data data --report papers.html --out papers.json");
  verb.argument("PAPER", arguments->paper, "Whose experiments").one_of(names).required();
  verb.argument("--seeds", arguments->seeds,
                "Worlds to simulate; figures in per cent take at least 100 walks")
      .in_range(1, 10000);
  verb.argument("--first-seed", arguments->first_seed,
                "Of the worlds; 1 without it. Tune on others than are reported");
  verb.argument("--preset", arguments->preset, "One simulated room alone. " + presets);
  verb.argument("--data", arguments->data,
                "Folder with the public recordings (ilc, ipin2023, oxford-steps, uji-mag); "
                "$WAYLODE_DATA without it; neither: simulation alone");
  verb.argument("--report", arguments->report,
                "HTML page to write; reproduce-PAPER.html without it");
  verb.argument("--out", arguments->out, "Write the figures as JSON to this file");
  verb.run([arguments, &context = verb.context()] {
    return reproduce(*arguments, context.command_line);
  });
}

}  // namespace waylode::cli
