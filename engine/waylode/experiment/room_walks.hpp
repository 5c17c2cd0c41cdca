// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "waylode/core/log_sink.hpp"
#include "waylode/core/result.hpp"
#include "waylode/experiment/bootstrap.hpp"
#include "waylode/experiment/outcome.hpp"
#include "waylode/experiment/paper_rooms.hpp"
#include "waylode/pipeline/session.hpp"

namespace waylode::experiment {

/// A method on trial; several may share a pipeline and differ in what they are told.
struct Contender {
  std::string label;   ///< As the tables name it.
  std::string method;  ///< As pipeline::find_method takes it.
  bool told_start = false;
};

/// What contenders did on the same walks.
struct Trials {
  std::vector<Contender> contenders;
  /// Per contender and walk: horizontal errors at the asked instants, m. An instant without a
  /// belief is charged half the diagonal of the floor.
  std::vector<std::vector<Unit>> errors_m;
  /// Of the first walk, per contender: where it was said to be, floor frame.
  std::vector<std::vector<core::Vector2>> example_tracks;
  std::vector<core::Vector2> example_truth;

  const std::vector<Unit>& of(const std::string& label) const;
};

/// A room with its walk for a seed.
using RoomMaker = std::function<core::Result<PaperRoom>(std::uint64_t seed)>;

/// Seeds `first_seed`, `first_seed` + 1, ...: for each a room and a walk in it, on which every
/// contender answers every `interval_s` from its first scan on. Causal: nothing after an instant is
/// used for it. `options` are the engine's; rooms change nothing about them.
core::Result<Trials> run_trials(const RoomMaker& make_room, std::uint64_t first_seed,
                                std::size_t walks, double interval_s,
                                const std::vector<Contender>& contenders,
                                const pipeline::Options& options,
                                const core::ProgressSink& progress);

/// "mean error, LABEL".
Figure mean_figure(const Trials& trials, const std::string& label, const std::string& id,
                   const std::string& paper);
/// "LABEL within LIMIT m".
Figure within_figure(const Trials& trials, const std::string& label, double limit_m,
                     const std::string& id, const std::string& paper);
/// "LABEL below OTHER", per cent less mean error on the same walks.
Figure reduction_figure(const Trials& trials, const std::string& label, const std::string& other,
                        const std::string& id, const std::string& paper);

/// Error curves of all contenders up to `most_m`, and the tracks of the first walk.
eval::LineChart error_curves(const Trials& trials, double most_m);
eval::LineChart example_tracks(const Trials& trials);
/// Mean errors with their intervals, one dot a contender.
eval::LineChart mean_bars(const Trials& trials);

}  // namespace waylode::experiment
