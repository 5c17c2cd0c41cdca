// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "waylode/core/fix.hpp"
#include "waylode/core/result.hpp"
#include "waylode/pipeline/method.hpp"
#include "waylode/pipeline/model.hpp"
#include "waylode/sample/sample.hpp"
#include "waylode/site/site.hpp"

namespace waylode::pipeline {

/// A place to start from, for methods that cannot find one by themselves.
struct StartPose {
  core::DeviceTime time;
  core::FloorId floor;
  core::Vector2 position_m = core::Vector2::Zero();  ///< Floor frame.
  double sigma_m = 1.0;
};

struct SessionOptions {
  std::optional<core::FloorId> known_floor;  ///< Told from outside; then never doubted.
  /// For methods that need one. `fused` and the papers' take it if given, as a belief that scans
  /// may overrule; methods that answer late pass it over.
  std::optional<StartPose> start;
};

class Estimator;

/// One phone: its samples in, fixes out. Deterministic, reads no clock; one thread at a time.
class Session {
 public:
  /// kInvalidArgument when the method needs a start and none is given, or for a floor that the
  /// site does not have; kMapMissing when the site lacks a map that the method needs.
  static core::Result<Session> create(std::shared_ptr<const Model> model, const Method& method,
                                      const SessionOptions& options);
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;
  ~Session();

  /// Samples in order of time (collate sees to that). Marks of the surveyor are not looked at.
  void push(const sample::Sample& sample);

  /// Where the phone is or was at `time`, from what was pushed. A causal method answers for
  /// instants from its newest sample on; a lagging one also for those up to its lag ago; a
  /// whole-track one for any instant.
  core::Fix fix_at(core::DeviceTime time) const;

 private:
  struct Pipeline;
  explicit Session(std::unique_ptr<Pipeline> pipeline);

  std::unique_ptr<Pipeline> pipeline_;
};

/// A recording run through a session, answering at the given instants (ascending) with nothing the
/// method may not know by then: samples up to instant + lag, or all for a whole-track method.
std::vector<core::Fix> replay(Session& session, const Method& method,
                              std::span<const sample::Sample> samples,
                              std::span<const core::DeviceTime> instants);

}  // namespace waylode::pipeline
