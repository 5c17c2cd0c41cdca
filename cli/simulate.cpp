// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/sim/simulate.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <system_error>

#include "command.hpp"
#include "progress_bar.hpp"
#include "waylode/core/file.hpp"
#include "waylode/log/mcap_writer.hpp"
#include "waylode/site/plan_geojson.hpp"

namespace waylode::cli {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::string scenario;
  std::string out;
  std::optional<std::uint64_t> seed;
};

core::Result<void> make_folder(const fs::path& folder) {
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (!problem && fs::is_directory(folder)) return {};
  return core::fail(core::ErrorCode::kFileUnwritable,
                    "cannot be made a folder (" +
                        (problem ? problem.message() : std::string("a file has this name")) +
                        "); name another",
                    folder.string());
}

core::Result<void> write_plans(const sim::Building& building, const fs::path& folder) {
  for (const site::FloorDraft& draft : building.floors) {
    const fs::path path = folder / ("plan-" + draft.floor.name + ".geojson");
    if (auto written = core::write_file_atomically(path, site::format_plan(draft)); !written) {
      return written;
    }
  }
  return {};
}

core::Result<void> write_log(const sim::SimulatedRecording& recording, const fs::path& path) {
  auto writer = log::McapWriter::create(path, recording.info);
  if (!writer) return tl::unexpected(writer.error());
  for (const sample::Sample& sample : recording.samples) {
    if (auto written = writer->write(sample); !written) return written;
  }
  return writer->close();
}

core::Result<void> write_truth(const sim::Building& building,
                               const sim::SimulatedRecording& recording, const fs::path& path) {
  std::string text = "time_s,floor,x_m,y_m,heading_rad,speed_mps\n";
  for (const sim::TruthState& state : recording.truth) {
    text += fmt::format("{:.3f},{},{:.4f},{:.4f},{:.5f},{:.3f}\n",
                        core::to_seconds(state.time.time_since_epoch()),
                        building.floor(state.floor).name, state.position_m.x(),
                        state.position_m.y(), state.heading_rad, state.speed_mps);
  }
  return core::write_file_atomically(path, text);
}

core::Result<void> write_recordings(const sim::Simulation& simulation, const fs::path& folder) {
  ProgressBar bar("writing");
  std::uint64_t done = 0;
  for (const sim::SimulatedRecording& recording : simulation.recordings) {
    if (auto written = write_log(recording, folder / (recording.walker + ".mcap")); !written) {
      return written;
    }
    const fs::path truth = folder / (recording.walker + "-truth.csv");
    if (auto written = write_truth(simulation.building, recording, truth); !written) {
      return written;
    }
    bar.show(++done, simulation.recordings.size());
  }
  return {};
}

core::Result<sim::Simulation> run_scenario(const Arguments& arguments) {
  auto scenario = sim::load_scenario(arguments.scenario);
  if (!scenario) return tl::unexpected(scenario.error());
  if (arguments.seed) scenario->seed = *arguments.seed;
  ProgressBar bar("walking");
  return sim::simulate(*scenario, bar.sink());
}

core::Result<void> simulate(const Arguments& arguments) {
  const auto simulation = run_scenario(arguments);
  if (!simulation) return tl::unexpected(simulation.error());
  const fs::path folder = arguments.out;
  if (auto made = make_folder(folder); !made) return made;
  if (auto written = write_plans(simulation->building, folder); !written) return written;
  if (auto written = write_recordings(*simulation, folder); !written) return written;
  print(fmt::format("wrote {} floor plans and {} recordings with truth to {}\n",
                    simulation->building.floors.size(), simulation->recordings.size(),
                    arguments.out));
  return {};
}

}  // namespace

void add_simulate(Verb& root) {
  const auto arguments = std::make_shared<Arguments>();
  Verb verb = root.verb("simulate", "Walk simulated people through a drawn building");
  verb.examples("  waylode simulate testdata/demo/demo_scenario.toml --out demo");
  verb.argument("SCENARIO", arguments->scenario, "The scenario (TOML, docs/simulator.md)")
      .required();
  verb.argument("--out", arguments->out,
                "Folder for plan-FLOOR.geojson, WALKER.mcap and WALKER-truth.csv")
      .required();
  verb.argument("--seed", arguments->seed, "Instead of the scenario's seed");
  verb.run([arguments] { return simulate(*arguments); });
}

}  // namespace waylode::cli
