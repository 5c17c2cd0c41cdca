// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/experiment/outcome.hpp"

namespace waylode::experiment {

std::optional<bool> Figure::reached() const {
  if (!bar) return std::nullopt;
  // A figure that could not be formed (NaN) reaches nothing.
  return bar->sense == Bar::Sense::kAtMost ? ours.value <= bar->limit : ours.value >= bar->limit;
}

Tally tally(const std::vector<Outcome>& outcomes) {
  Tally tally;
  for (const Outcome& outcome : outcomes) {
    for (const Figure& figure : outcome.figures) {
      if (!figure.bar) continue;
      ++tally.judged;
      if (*figure.reached()) ++tally.reached;
    }
  }
  return tally;
}

}  // namespace waylode::experiment
