// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "datasets/split.hpp"
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

/// A recording of the training part that was kept aside: its marks may be read by nobody.
struct UnlabelledRecording {
  std::string name;
  std::string group;  ///< As TestCase::group; the site alone where the floor is not told.
  std::shared_ptr<const pipeline::Model> model;
  std::function<core::Result<std::vector<sample::Sample>>()> load;  ///< Without marks.
};

/// Maps built from the training part, and the tests.
struct Dataset {
  std::string name;
  bool has_covered = false;  ///< The `covered` group exists.
  std::vector<TestCase> tests;
  std::vector<UnlabelledRecording> unlabelled;  ///< Left out of the maps.
};

/// What building a data set needs besides its files.
struct DatasetContext {
  pipeline::Options options;
  core::ProgressSink progress;
  core::LogSink log;  ///< What was left out and why; called by one thread.
  Dealing dealing{};  ///< For recordings that no split table names.
};

}  // namespace waylode::cli
