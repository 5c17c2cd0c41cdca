// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "run_evaluation.hpp"

#include <time.h>

#include <atomic>
#include <exception>
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
  if (method.needs_start()) {
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
    truth.scored =
        test.score_all || method.whole_track() || (first_scan && truth.time >= *first_scan);
    instants.push_back(truth.time);
  }
  // Dead reckoning was told where it starts.
  if (method.needs_start()) track.truths.front().scored = false;
  // Maps that a method needs are made once for all recordings: no part of what one costs.
  if (auto ready = test.model->prepare(method); !ready) return tl::unexpected(ready.error());
  const double started_s = thread_cpu_s();
  auto session = pipeline::Session::create(test.model, method,
                                           session_options(test, recording, method, floor_known));
  if (!session) return tl::unexpected(session.error());
  track.fixes = pipeline::replay(*session, method, recording.samples, instants);
  track.cpu_s = thread_cpu_s() - started_s;
  return track;
}

/// Shared by the threads: deals out the tests in order and collects tracks and failures.
class Evaluation {
 public:
  Evaluation(const Dataset& dataset, const EvaluationOptions& options,
             const core::ProgressSink& progress)
      : dataset_(dataset),
        options_(options),
        progress_(progress),
        end_(dataset.tests.size()),
        tracks_(dataset.tests.size() * options.methods.size()) {}

  /// Runs tests until none is left or one has failed. For any number of threads.
  void work() {
    for (std::size_t i = next_++; i < end_; i = next_++) {
      try {
        const core::Result<void> ran = run_test(i);
        if (!ran) fail(i, ran.error(), nullptr);
      } catch (...) {
        fail(i, {}, std::current_exception());
      }
    }
  }

  /// After all threads are done. Every test before a failed one has run to its end, so the first
  /// failure by order does not depend on the threads.
  core::Result<std::vector<eval::EvaluatedTrack>> take() {
    if (exception_) std::rethrow_exception(exception_);
    if (end_ < dataset_.tests.size()) return tl::unexpected(error_);
    return std::move(tracks_);
  }

 private:
  core::Result<void> run_test(std::size_t i) {
    const TestCase& test = dataset_.tests[i];
    const core::Result<TestRecording> recording = test.load();
    if (!recording) return tl::unexpected(recording.error());
    for (std::size_t m = 0; m < options_.methods.size() && i < end_; ++m) {
      auto track = run_method(test, *recording, options_.methods[m], options_.floor_known);
      if (!track) return tl::unexpected(track.error());
      tracks_[i * options_.methods.size() + m] = *std::move(track);
    }
    const std::scoped_lock lock(mutex_);
    if (progress_) progress_(++done_, dataset_.tests.size());
    return {};
  }

  void fail(std::size_t i, core::Error error, std::exception_ptr exception) {
    const std::scoped_lock lock(mutex_);
    if (i >= end_) return;
    end_ = i;
    error_ = std::move(error);
    exception_ = std::move(exception);
  }

  const Dataset& dataset_;
  const EvaluationOptions& options_;
  const core::ProgressSink& progress_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<std::size_t> end_;  ///< The first failed test; written under the mutex.
  std::vector<eval::EvaluatedTrack> tracks_;
  std::mutex mutex_;  ///< Guards what follows and the progress sink.
  std::size_t done_ = 0;
  core::Error error_;  ///< Of the test at `end_`, unless it threw.
  std::exception_ptr exception_;
};

}  // namespace

core::Result<std::vector<eval::EvaluatedTrack>> run_evaluation(const Dataset& dataset,
                                                               const EvaluationOptions& options,
                                                               const core::ProgressSink& progress) {
  Evaluation evaluation(dataset, options, progress);
  {
    std::vector<std::jthread> workers;
    for (unsigned i = 1; i < options.threads; ++i) {
      workers.emplace_back([&] { evaluation.work(); });
    }
    evaluation.work();
  }
  return evaluation.take();
}

}  // namespace waylode::cli
