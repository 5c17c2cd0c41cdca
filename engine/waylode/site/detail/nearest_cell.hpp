// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace waylode::site::detail {

/// Column and row of a cell of a raster.
struct CellIndex {
  std::uint16_t column = 0;
  std::uint16_t row = 0;
  bool operator==(const CellIndex&) const = default;
};

/// Marks on a raster, row by row; at most 65535 columns and rows.
struct CellMarks {
  int columns = 0;
  int rows = 0;
  std::vector<std::uint8_t> marked;  ///< `columns * rows` of 0 or 1.
};

/// For every cell the marked one whose centre is nearest, exact (Euclidean distance transform with
/// the places it comes from); a marked cell is its own. Empty when nothing is marked.
std::vector<CellIndex> nearest_marked(const CellMarks& marks);

}  // namespace waylode::site::detail
