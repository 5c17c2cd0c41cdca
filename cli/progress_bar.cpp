// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "progress_bar.hpp"

#include <unistd.h>

#include <cstdio>
#include <utility>

namespace waylode::cli {

ProgressBar::ProgressBar(std::string title)
    : title_(std::move(title)), on_terminal_(::isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (on_terminal_ && shown_percent_ >= 0) std::fputs("\r\033[K", stderr);
}

void ProgressBar::show(std::uint64_t done, std::uint64_t total) {
  if (!on_terminal_ || total == 0) return;
  const int percent = static_cast<int>(100 * done / total);
  if (percent == shown_percent_) return;
  shown_percent_ = percent;
  constexpr int kPercentPerCell = 4;
  const auto filled = static_cast<std::size_t>(percent / kPercentPerCell);
  std::string cells(100 / kPercentPerCell, '.');
  for (std::size_t i = 0; i < filled && i < cells.size(); ++i) cells[i] = '#';
  std::fprintf(stderr, "\r%s [%s] %3d %%", title_.c_str(), cells.c_str(), percent);
}

}  // namespace waylode::cli
