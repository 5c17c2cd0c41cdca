// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "waylode/eval/svg_chart.hpp"

namespace waylode::experiment {

/// A measured figure with its 95 % bootstrap interval.
struct Interval {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
  std::size_t n = 0;  ///< Independent units behind it: walks, draws, recordings.

  bool operator==(const Interval&) const = default;
};

/// What a figure has to reach.
struct Bar {
  enum class Sense : std::uint8_t { kAtMost, kAtLeast };
  Sense sense = Sense::kAtMost;
  double limit = 0.0;

  bool operator==(const Bar&) const = default;
};

/// One figure beside the paper's.
struct Figure {
  std::string id;     ///< Of the experiment in the specification: "W-X1".
  std::string what;   ///< "mean error, fused".
  std::string unit;   ///< "m", "%", "dB", ...
  std::string paper;  ///< The paper's figure as text; empty where it gives none.
  Interval ours;
  std::optional<Bar> bar;  ///< None: reported, not judged.
  std::string note;        ///< One sentence, where the figure needs one.

  /// Judged by the measured value; the interval says how sure that is. nullopt without a bar.
  std::optional<bool> reached() const;
};

/// One experiment on one body of data.
struct Outcome {
  std::string paper;  ///< "wu2019".
  std::string title;  ///< "Car park, preset I".
  std::string data;   ///< What it ran on: "simulation, 100 walks, seeds 1 to 100".
  std::vector<Figure> figures;
  std::vector<eval::LineChart> charts;
  std::vector<std::string> notes;  ///< What was left out and why, one sentence each.
};

/// How many figures have a bar, and how many of these reach it.
struct Tally {
  std::size_t reached = 0;
  std::size_t judged = 0;
};
Tally tally(const std::vector<Outcome>& outcomes);

}  // namespace waylode::experiment
