// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/detail/nearest_cell.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <limits>

namespace waylode::site::detail {
namespace {

constexpr int kNone = -1;

/// The row of the nearest mark in each cell's own column; kNone in a column without.
std::vector<int> nearest_rows(const CellMarks& marks) {
  const auto columns = static_cast<std::size_t>(marks.columns);
  std::vector<int> nearest(marks.marked.size(), kNone);
  for (std::size_t cell = 0; cell < nearest.size(); ++cell) {
    if (marks.marked[cell] != 0) {
      nearest[cell] = static_cast<int>(cell / columns);
    } else if (cell >= columns) {
      nearest[cell] = nearest[cell - columns];
    }
  }
  for (std::size_t cell = nearest.size(); cell-- > columns;) {
    const int below = nearest[cell];
    const int row = static_cast<int>(cell / columns) - 1;
    int& above = nearest[cell - columns];
    if (below != kNone && (above == kNone || below - row < row - above)) above = below;
  }
  return nearest;
}

/// Lower envelope of the parabolas that stand on a row's columns.
/// [Felzenszwalb2012] algorithm 1; the divisions are exact wherever they decide.
class Envelope {
 public:
  void clear() { vertices_.clear(); }
  void add(int column, double height) {
    double from = -std::numeric_limits<double>::infinity();
    while (!vertices_.empty()) {
      const Vertex& last = vertices_.back();
      from = (height + squared(column) - last.height - squared(last.column)) /
             (2.0 * (column - last.column));
      if (from > last.from) break;
      vertices_.pop_back();
      from = -std::numeric_limits<double>::infinity();
    }
    vertices_.push_back({column, height, from});
  }
  /// Calls `visit(column, its vertex's column)` for the columns 0..count-1.
  template <typename Visit>
  void for_each(int count, Visit&& visit) const {
    std::size_t vertex = 0;
    for (int column = 0; column < count; ++column) {
      while (vertex + 1 < vertices_.size() && vertices_[vertex + 1].from < column) ++vertex;
      visit(column, vertices_[vertex].column);
    }
  }

 private:
  struct Vertex {
    int column;
    double height;
    double from;  ///< Lowest of all to the right of this place.
  };
  static double squared(double value) { return value * value; }

  std::vector<Vertex> vertices_;
};

}  // namespace

std::vector<CellIndex> nearest_marked(const CellMarks& marks) {
  if (std::ranges::find(marks.marked, 1) == marks.marked.end()) return {};
  const std::vector<int> rows = nearest_rows(marks);
  std::vector<CellIndex> nearest(rows.size());
  Envelope envelope;
  for (int row = 0; row < marks.rows; ++row) {
    const std::size_t begin =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(marks.columns);
    envelope.clear();
    for (int column = 0; column < marks.columns; ++column) {
      const int marked_row = rows[begin + static_cast<std::size_t>(column)];
      if (marked_row == kNone) continue;
      const double height = marked_row - row;
      envelope.add(column, height * height);
    }
    envelope.for_each(marks.columns, [&](int column, int from) {
      nearest[begin + static_cast<std::size_t>(column)] = {
          static_cast<std::uint16_t>(from),
          static_cast<std::uint16_t>(rows[begin + static_cast<std::size_t>(from)])};
    });
  }
  return nearest;
}

}  // namespace waylode::site::detail
