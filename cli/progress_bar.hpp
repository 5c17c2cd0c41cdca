// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "waylode/core/log_sink.hpp"

namespace waylode::cli {

/// A line on standard error that shows how far long work has come; silent unless standard error is
/// a terminal. The line is wiped when the bar goes.
class ProgressBar {
 public:
  explicit ProgressBar(std::string title);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar();

  void show(std::uint64_t done, std::uint64_t total);
  /// For the engine; the bar must outlive the sink.
  core::ProgressSink sink() {
    return [this](std::uint64_t done, std::uint64_t total) { show(done, total); };
  }

 private:
  std::string title_;
  bool on_terminal_;
  int shown_percent_ = -1;
};

}  // namespace waylode::cli
