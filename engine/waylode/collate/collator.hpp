// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "waylode/core/result.hpp"
#include "waylode/core/time.hpp"
#include "waylode/sample/sample.hpp"

namespace waylode::collate {

/// Puts the samples of a live stream, which arrive slightly out of order, into order of time.
///
/// A sample leaves once the newest time seen is max_lateness past its own; samples of equal time
/// leave in the order they came. One that comes when later samples have already left is dropped and
/// counted: what leaves is ordered, always. Deterministic; holds at most max_held samples.
class Collator {
 public:
  struct Options {
    /// How long to wait for stragglers. Fixes lag by it; raise it if drops are counted. 0 to 60 s.
    core::Duration max_lateness = std::chrono::milliseconds(500);
    /// Beyond it the oldest leave early, so that a broken clock cannot fill the memory. At least 1.
    std::size_t max_held = 65536;

    core::Result<void> validate() const;
  };
  /// kInvalidOptions.
  static core::Result<Collator> create(Options options);

  void push(sample::Sample&& sample);
  /// The samples that are due, in order. Empties the due ones only.
  std::vector<sample::Sample> take_ready();
  /// All that is held, in order: the stream has ended or paused. What comes later and is older
  /// counts as too late.
  std::vector<sample::Sample> flush();

  std::size_t held_count() const { return held_.size(); }
  std::uint64_t dropped_count() const { return dropped_count_; }

 private:
  /// A min-heap by (time, order of arrival).
  struct Held {
    core::DeviceTime time;
    std::uint64_t sequence;
    sample::Sample sample;
  };

  explicit Collator(Options options) : options_(options) {}
  static bool leaves_after(const Held& a, const Held& b);
  sample::Sample pop_oldest();

  Options options_;
  std::vector<Held> held_;
  std::uint64_t next_sequence_ = 0;
  std::uint64_t dropped_count_ = 0;
  core::DeviceTime newest_ = core::DeviceTime::min();
  core::DeviceTime last_left_ = core::DeviceTime::min();
};

}  // namespace waylode::collate
