// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "run_evaluation.hpp"

#include <time.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>

namespace waylode::cli {
namespace {

double thread_cpu_s() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::optional<core::DeviceTime> first_usable_scan(const std::vector<sample::Sample>& samples) {
  for (const sample::Sample& sample : samples) {
    const auto* scan = std::get_if<sample::WifiScan>(&sample);
    if (scan != nullptr && !scan->readings.empty()) return scan->time;
  }
  return std::nullopt;
}

pipeline::SessionOptions session_options(const TestCase& test, const TestRecording& recording,
                                         const pipeline::Method& method, bool floor_known) {
  pipeline::SessionOptions options;
  if (floor_known) options.known_floor = test.floor;
  if (method.kind == pipeline::MethodKind::kPdr) {
    const eval::TruthPoint& start = recording.truths.front();
    options.start = pipeline::StartPose{start.time, start.floor, start.position_m, 1.0};
  }
  return options;
}

core::Result<eval::EvaluatedTrack> run_method(const TestCase& test, const TestRecording& recording,
                                              const pipeline::Method& method, bool floor_known) {
  eval::EvaluatedTrack track;
  track.name = test.name;
  track.group = test.group;
  track.method = std::string(method.name);
  track.covered = test.covered;
  track.site = test.model->site();
  track.truths = recording.truths;
  if (track.truths.empty()) return track;
  track.walked_s = core::to_seconds(track.truths.back().time - track.truths.front().time);

  const std::optional<core::DeviceTime> first_scan = first_usable_scan(recording.samples);
  std::vector<core::DeviceTime> instants;
  for (eval::TruthPoint& truth : track.truths) {
    truth.scored = method.whole_track() || (first_scan && truth.time >= *first_scan);
    instants.push_back(truth.time);
  }
  const double started_s = thread_cpu_s();
  auto session = pipeline::Session::create(test.model, method,
                                           session_options(test, recording, method, floor_known));
  if (!session) return tl::unexpected(session.error());
  track.fixes = pipeline::replay(*session, method, recording.samples, instants);
  track.cpu_s = thread_cpu_s() - started_s;
  return track;
}

}  // namespace

core::Result<std::vector<eval::EvaluatedTrack>> run_evaluation(const Dataset& dataset,
                                                               const EvaluationOptions& options,
                                                               const core::ProgressSink& progress) {
  const std::size_t method_count = options.methods.size();
  std::vector<eval::EvaluatedTrack> tracks(dataset.tests.size() * method_count);
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;  // Guards `first_error`, `done` and the progress sink.
  std::optional<core::Error> first_error;
  std::size_t done = 0;

  const auto work = [&] {
    for (std::size_t i = next++; i < dataset.tests.size(); i = next++) {
      const TestCase& test = dataset.tests[i];
      std::optional<core::Error> error;
      const core::Result<TestRecording> recording = test.load();
      if (!recording) error = recording.error();
      for (std::size_t m = 0; m < method_count && !error; ++m) {
        auto track = run_method(test, *recording, options.methods[m], options.floor_known);
        if (track) {
          tracks[i * method_count + m] = *std::move(track);
        } else {
          error = track.error();
        }
      }
      const std::scoped_lock lock(mutex);
      if (error && !first_error) first_error = error;
      if (first_error) return;
      if (progress) progress(++done, dataset.tests.size());
    }
  };
  std::vector<std::jthread> workers;
  for (unsigned i = 1; i < options.threads; ++i) workers.emplace_back(work);
  work();
  workers.clear();
  if (first_error) return tl::unexpected(*first_error);
  return tracks;
}

}  // namespace waylode::cli
