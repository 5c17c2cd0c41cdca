// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "run_evaluation.hpp"

#include <time.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <mutex>
#include <thread>

#include "waylode/core/angle.hpp"
#include "waylode/core/rng.hpp"

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

pipeline::StartPose wrong_start(const eval::TruthPoint& start, const WrongStart& wrong,
                                std::size_t test_number) {
  core::Rng rng(wrong.seed + test_number);
  const double direction_rad = rng.uniform(0.0, 2.0 * core::kPi);
  const core::Vector2 offset_m =
      wrong.offset_m * core::Vector2(std::cos(direction_rad), std::sin(direction_rad));
  return {start.time, start.floor, start.position_m + offset_m, wrong.sigma_m};
}

pipeline::SessionOptions session_options(const TestCase& test, const TestRecording& recording,
                                         const pipeline::Method& method,
                                         const EvaluationOptions& evaluation,
                                         std::size_t test_number) {
  pipeline::SessionOptions options;
  if (evaluation.floor_known) options.known_floor = test.floor;
  const eval::TruthPoint& start = recording.truths.front();
  if (evaluation.wrong_start) {
    options.start = wrong_start(start, *evaluation.wrong_start, test_number);
  } else if (method.needs_start()) {
    options.start = pipeline::StartPose{start.time, start.floor, start.position_m, 1.0};
  }
  return options;
}

bool changes_floor(const std::vector<eval::TruthPoint>& truths) {
  return std::ranges::any_of(
      truths, [&](const eval::TruthPoint& truth) { return truth.floor != truths.front().floor; });
}

/// The truths' instants and, if wanted, those of the path; each says whose it is.
struct Instants {
  std::vector<core::DeviceTime> times;  ///< Ascending.
  std::vector<bool> of_path;            ///< Parallel.
};

Instants instants_of(const std::vector<eval::TruthPoint>& truths, bool with_path) {
  constexpr core::Duration kPathPeriod = std::chrono::seconds(1);
  Instants instants;
  core::DeviceTime next = truths.front().time;
  const auto add = [&](core::DeviceTime time, bool of_path) {
    instants.times.push_back(time);
    instants.of_path.push_back(of_path);
  };
  for (const eval::TruthPoint& truth : truths) {
    for (; with_path && next <= truth.time; next += kPathPeriod) add(next, true);
    add(truth.time, false);
  }
  return instants;
}

void deal_fixes(std::vector<core::Fix> fixes, const Instants& instants,
                eval::EvaluatedTrack& track) {
  for (std::size_t i = 0; i < fixes.size(); ++i) {
    (instants.of_path[i] ? track.path : track.fixes).push_back(std::move(fixes[i]));
  }
}

core::Result<eval::EvaluatedTrack> run_method(const TestCase& test, const TestRecording& recording,
                                              const pipeline::Method& method,
                                              const EvaluationOptions& options,
                                              std::size_t test_number) {
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
  for (eval::TruthPoint& truth : track.truths) {
    truth.scored =
        test.score_all || method.whole_track() || (first_scan && truth.time >= *first_scan);
  }
  const Instants instants =
      instants_of(track.truths, options.with_path || changes_floor(track.truths));
  // Dead reckoning was told where it starts.
  if (method.needs_start()) track.truths.front().scored = false;
  // Maps that a method needs are made once for all recordings: no part of what one costs.
  if (auto ready = test.model->prepare(method); !ready) return tl::unexpected(ready.error());
  const double started_s = thread_cpu_s();
  auto session = pipeline::Session::create(
      test.model, method, session_options(test, recording, method, options, test_number));
  if (!session) return tl::unexpected(session.error());
  auto fixes = pipeline::replay(*session, method, recording.samples, instants.times);
  track.cpu_s = thread_cpu_s() - started_s;
  deal_fixes(std::move(fixes), instants, track);
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
    core::Result<TestRecording> recording = test.load();
    if (!recording) return tl::unexpected(recording.error());
    alter(recording->samples, options_.alteration);
    for (std::size_t m = 0; m < options_.methods.size() && i < end_; ++m) {
      auto track = run_method(test, *recording, options_.methods[m], options_, i);
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
