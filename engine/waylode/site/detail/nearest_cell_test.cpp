// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/detail/nearest_cell.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

namespace waylode::site::detail {
namespace {

int distance2(CellIndex cell, int column, int row) {
  const int across = cell.column - column;
  const int along = cell.row - row;
  return across * across + along * along;
}

TEST(NearestCell, IsNoneWithoutAMark) {
  EXPECT_TRUE(nearest_marked({3, 2, {0, 0, 0, 0, 0, 0}}).empty());
  EXPECT_TRUE(nearest_marked({0, 0, {}}).empty());
}

TEST(NearestCell, IsTheOnlyMarkFromEverywhere) {
  const auto nearest = nearest_marked({3, 2, {0, 0, 0, 0, 0, 1}});
  ASSERT_EQ(nearest.size(), 6U);
  for (const CellIndex cell : nearest) EXPECT_EQ(cell, (CellIndex{2, 1}));
  EXPECT_EQ(nearest_marked({1, 1, {1}}), (std::vector<CellIndex>{{0, 0}}));
}

RC_GTEST_PROP(NearestCell, IsAsNearAsASearchOverAllMarksFinds, ()) {
  CellMarks marks;
  marks.columns = *rc::gen::inRange(1, 24);
  marks.rows = *rc::gen::inRange(1, 24);
  const int one_in = *rc::gen::element(2, 8, 60);
  marks.marked.resize(static_cast<std::size_t>(marks.columns * marks.rows));
  for (auto& mark : marks.marked) {
    mark = static_cast<std::uint8_t>(*rc::gen::inRange(0, one_in) == 0 ? 1 : 0);
  }
  const auto nearest = nearest_marked(marks);
  std::size_t cell = 0;
  for (int row = 0; row < marks.rows; ++row) {
    for (int column = 0; column < marks.columns; ++column, ++cell) {
      int least = std::numeric_limits<int>::max();
      for (int r = 0; r < marks.rows; ++r) {
        for (int c = 0; c < marks.columns; ++c) {
          if (marks.marked[static_cast<std::size_t>(r * marks.columns + c)] == 0) continue;
          least = std::min(least,
                           distance2({static_cast<std::uint16_t>(c), static_cast<std::uint16_t>(r)},
                                     column, row));
        }
      }
      if (least == std::numeric_limits<int>::max()) {
        RC_ASSERT(nearest.empty());
        return;
      }
      RC_ASSERT(distance2(nearest[cell], column, row) == least);
      const auto found =
          static_cast<std::size_t>(nearest[cell].row * marks.columns) + nearest[cell].column;
      RC_ASSERT(marks.marked[found] == 1);
    }
  }
}

}  // namespace
}  // namespace waylode::site::detail
