// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "waylode/core/log_sink.hpp"
#include "waylode/core/result.hpp"
#include "waylode/eval/evaluated_track.hpp"
#include "waylode/pipeline/session.hpp"
#include "waylode/sample/sample.hpp"

namespace waylode::cli {

/// A recording to be judged: what the phone heard and felt, and where it was.
struct TestRecording {
  std::vector<sample::Sample> samples;   ///< By time; readings from before the recording are gone.
  std::vector<eval::TruthPoint> truths;  ///< By time.
};

/// A test of a data set, loaded only when its turn comes.
struct TestCase {
  std::string name;
  std::string group;  ///< "<site>/<floor>".
  bool covered = false;
  std::shared_ptr<const pipeline::Model> model;
  std::optional<core::FloorId> floor;  ///< The one floor of the recording, where it has just one.
  /// Truths from before the first scan with a reading count too, whatever the method.
  bool score_all = false;
  std::function<core::Result<TestRecording>()> load;
};

/// Maps built from the training part, and the tests.
struct Dataset {
  std::string name;
  bool has_covered = false;  ///< The `covered` group exists.
  std::vector<TestCase> tests;
};

/// What building a data set needs besides its files.
struct DatasetContext {
  pipeline::Options options;
  core::ProgressSink progress;
  core::LogSink log;  ///< What was left out and why; called by one thread.
};

}  // namespace waylode::cli
