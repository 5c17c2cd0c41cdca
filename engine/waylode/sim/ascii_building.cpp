// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/sim/ascii_building.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "waylode/sim/detail/cell_grid.hpp"

namespace waylode::sim {

namespace {

using core::ErrorCode;

struct Line {
  std::string_view text;
  int number = 0;
};

struct DrawnFloor {
  std::string name;
  int level = 0;
  double elevation_m = 0.0;
  int header_line = 0;
  std::vector<Line> rows;
};

/// What a floor's drawing says, in cells; row 0 the southernmost.
struct ReadFloor {
  detail::CellGrid grid;
  std::vector<std::pair<char, core::Vector2>> marks;
  std::set<std::pair<int, int>> stairs;
};

tl::unexpected<core::Error> fail_at(std::string_view place, int line, std::string message) {
  return core::fail(ErrorCode::kScenarioInvalid, std::move(message),
                    std::string(place) + ":" + std::to_string(line));
}

std::vector<Line> split_lines(std::string_view text, int first_line) {
  std::vector<Line> lines;
  int number = first_line;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    lines.push_back({line, number++});
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::vector<std::string_view> split_words(std::string_view line) {
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t begin = line.find_first_not_of(' ');
    if (begin == std::string_view::npos) return words;
    line.remove_prefix(begin);
    const std::size_t end = std::min(line.find(' '), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

template <typename T>
std::optional<T> parse_number(std::string_view word) {
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

core::Result<DrawnFloor> parse_header(const Line& line, std::string_view place) {
  const std::vector<std::string_view> words = split_words(line.text);
  const bool shaped =
      words.size() == 6 && words[0] == "floor" && words[2] == "level" && words[4] == "elevation_m";
  const std::optional<int> level = shaped ? parse_number<int>(words[3]) : std::nullopt;
  const std::optional<double> elevation_m = shaped ? parse_number<double>(words[5]) : std::nullopt;
  constexpr double kHighest_m = 2000.0;
  if (!level || !elevation_m || !(std::abs(*elevation_m) <= kHighest_m)) {
    return fail_at(place, line.number,
                   "expected a floor's header; write it like 'floor F1 level 0 elevation_m 0'");
  }
  return DrawnFloor{std::string(words[1]), *level, *elevation_m, line.number, {}};
}

core::Result<std::vector<DrawnFloor>> split_floors(std::string_view text, std::string_view place,
                                                   int first_line) {
  std::vector<DrawnFloor> floors;
  for (const Line& line : split_lines(text, first_line)) {
    const bool is_blank = line.text.find_first_not_of(' ') == std::string_view::npos;
    if (is_blank) continue;
    const std::size_t begin = line.text.find_first_not_of(' ');
    if (line.text.substr(begin).starts_with("floor ")) {
      auto floor = parse_header(line, place);
      if (!floor) return tl::unexpected(std::move(floor.error()));
      floors.push_back(std::move(*floor));
    } else if (floors.empty()) {
      return fail_at(place, line.number,
                     "a row before any floor; start with 'floor F1 level 0 elevation_m 0'");
    } else {
      if (!floors.back().rows.empty() && floors.back().rows.back().number + 1 != line.number) {
        return fail_at(place, line.number, "a blank line splits a floor; fill it with '#' or '.'");
      }
      floors.back().rows.push_back(line);
    }
  }
  if (floors.empty()) {
    return fail_at(place, first_line,
                   "no floor is drawn; start with 'floor F1 level 0 elevation_m 0'");
  }
  return floors;
}

core::Result<ReadFloor> read_rows(const DrawnFloor& drawn, std::string_view place, double cell_m) {
  std::size_t columns = 0;
  for (const Line& row : drawn.rows) columns = std::max(columns, row.text.size());
  constexpr std::size_t kMostCells = 4'000'000;
  if (drawn.rows.empty() || columns * drawn.rows.size() > kMostCells) {
    return fail_at(
        place, drawn.header_line,
        "floor '" + drawn.name + "' has no rows or more than 4 million cells; redraw it");
  }
  const int row_count = static_cast<int>(drawn.rows.size());
  ReadFloor read{detail::CellGrid(static_cast<int>(columns), row_count, cell_m), {}, {}};
  std::set<char> seen;
  for (int i = 0; i < row_count; ++i) {
    const Line& line = drawn.rows[static_cast<std::size_t>(i)];
    const int row = row_count - 1 - i;
    for (int column = 0; column < static_cast<int>(line.text.size()); ++column) {
      const char cell = line.text[static_cast<std::size_t>(column)];
      if (cell == '#') continue;
      read.grid.set_free(column, row);
      if (cell == '.' || cell == ' ' || cell == '+') continue;
      if (cell == '^') {
        read.stairs.emplace(column, row);
        continue;
      }
      const bool is_mark = (cell >= '0' && cell <= '9') || (cell >= 'A' && cell <= 'Z') ||
                           (cell >= 'a' && cell <= 'z');
      if (!is_mark) {
        return fail_at(place, line.number,
                       "column " + std::to_string(column + 1) +
                           " is none of '# . + ^', a letter or a digit; replace it");
      }
      if (!seen.insert(cell).second) {
        return fail_at(place, line.number,
                       std::string("'") + cell + "' is drawn twice on floor '" + drawn.name +
                           "'; use another letter or digit");
      }
      read.marks.emplace_back(cell, read.grid.centre_m(column, row));
    }
  }
  return read;
}

site::FloorDraft draft_of(const DrawnFloor& drawn, const detail::CellGrid& grid) {
  site::FloorDraft draft;
  draft.floor.name = drawn.name;
  draft.floor.level = drawn.level;
  draft.floor.elevation_m = drawn.elevation_m;
  draft.floor.bounds.max_m = {grid.columns() * grid.cell_m(), grid.rows() * grid.cell_m()};
  draft.floor.plan.walkable = detail::outline_free_cells(grid);
  draft.floor.plan.walls = detail::face_walls(grid);
  return draft;
}

void add_marks(const ReadFloor& read, core::FloorId floor, Building& building) {
  for (const auto& [mark, position_m] : read.marks) {
    const std::string name(1, mark);
    if (mark >= '0' && mark <= '9') {
      building.points.push_back({name, floor, position_m});
    } else {
      const auto kind = mark >= 'a' ? Transmitter::Kind::kBluetooth : Transmitter::Kind::kWifi;
      building.transmitters.push_back({kind, name, floor, position_m});
    }
  }
}

/// Takes one connected block of cells out of `cells`.
std::vector<std::pair<int, int>> take_block(std::set<std::pair<int, int>>& cells) {
  std::vector<std::pair<int, int>> block = {*cells.begin()};
  cells.erase(cells.begin());
  for (std::size_t next = 0; next < block.size(); ++next) {
    const auto [column, row] = block[next];
    for (const auto& neighbour : {std::pair(column + 1, row), std::pair(column - 1, row),
                                  std::pair(column, row + 1), std::pair(column, row - 1)}) {
      if (cells.erase(neighbour) != 0) block.push_back(neighbour);
    }
  }
  return block;
}

/// Stairs are blocks of cells drawn at the same place on both floors.
void add_stairs(const ReadFloor& lower, const ReadFloor& upper, core::FloorId lower_floor,
                Building& building) {
  std::set<std::pair<int, int>> shared;
  std::set_intersection(lower.stairs.begin(), lower.stairs.end(), upper.stairs.begin(),
                        upper.stairs.end(), std::inserter(shared, shared.end()));
  const double cell_m = lower.grid.cell_m();
  while (!shared.empty()) {
    const auto block = take_block(shared);
    auto [left, right] = std::minmax_element(block.begin(), block.end());
    int bottom = block.front().second;
    int top = bottom;
    for (const auto& [column, row] : block) {
      bottom = std::min(bottom, row);
      top = std::max(top, row);
    }
    const core::Vector2 centre_m(0.5 * (left->first + right->first + 1) * cell_m,
                                 0.5 * (bottom + top + 1) * cell_m);
    const int narrow = std::min(right->first - left->first, top - bottom) + 1;
    constexpr double kFromEdge_m = 0.4;
    const double radius_m = std::clamp(0.5 * narrow * cell_m - kFromEdge_m, 0.1, 1.5);
    building.stairwells.push_back({lower_floor, centre_m, radius_m});
  }
}

}  // namespace

core::Result<Building> parse_ascii_building(std::string_view text, std::string_view place,
                                            const AsciiBuildingOptions& options) {
  if (!(options.cell_m >= 0.2 && options.cell_m <= 10.0)) {
    return fail_at(place, options.first_line, "cell_m must be 0.2 to 10 metres");
  }
  auto drawn = split_floors(text, place, options.first_line);
  if (!drawn) return tl::unexpected(std::move(drawn.error()));
  std::map<int, ReadFloor> read_by_level;
  std::vector<site::FloorDraft> drafts;
  for (const DrawnFloor& floor : *drawn) {
    auto read = read_rows(floor, place, options.cell_m);
    if (!read) return tl::unexpected(std::move(read.error()));
    drafts.push_back(draft_of(floor, read->grid));
    read_by_level.emplace(floor.level, std::move(*read));
  }
  auto building = building_from_plans({}, std::move(drafts));
  if (!building) {
    return fail_at(place, options.first_line, std::move(building.error().message));
  }
  building->radio_walls.clear();
  const ReadFloor* below = nullptr;
  std::uint16_t index = 0;
  for (const auto& [level, read] : read_by_level) {
    building->radio_walls.push_back(detail::centre_walls(read.grid));
    add_marks(read, core::FloorId{index}, *building);
    if (below != nullptr) {
      add_stairs(*below, read, core::FloorId{static_cast<std::uint16_t>(index - 1)}, *building);
    }
    below = &read;
    ++index;
  }
  return building;
}

}  // namespace waylode::sim
