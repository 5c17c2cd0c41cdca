// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/fingerprint_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "waylode/log/detail/byte_stream.hpp"
#include "waylode/log/detail/fields.hpp"
#include "waylode/log/detail/limits.hpp"
#include "waylode/log/detail/line_splitter.hpp"

namespace waylode::log {
namespace {

using Rows = std::vector<sample::FingerprintRow>;

constexpr double kNotHeard = 100.0;
/// Projected coordinates reach ten thousand kilometres from the equator.
constexpr double kMaxProjected_m = 1e8;
constexpr std::size_t kMaxNameLength = 64;

enum PlaceColumn : std::size_t { kLongitude, kLatitude, kFloor, kBuilding, kPlaceColumns };
constexpr std::array<std::string_view, kPlaceColumns> kPlaceNames = {"LONGITUDE", "LATITUDE",
                                                                     "FLOOR", "BUILDINGID"};

/// What a column of the file holds.
struct Column {
  enum class Kind : std::uint8_t { kOther, kTransmitter, kPlace };
  Kind kind = Kind::kOther;
  std::uint64_t index = 0;  ///< Transmitter's number, or PlaceColumn.
};

std::optional<Column> parse_column(std::string_view name) {
  for (std::size_t i = 0; i < kPlaceNames.size(); ++i) {
    if (name == kPlaceNames[i]) return Column{Column::Kind::kPlace, i};
  }
  if (!name.starts_with("WAP")) return Column{};
  const auto number = detail::parse_integer<std::uint32_t>(name.substr(3));
  if (!number) return std::nullopt;
  return Column{Column::Kind::kTransmitter, *number};
}

/// Takes the first field off `line`; false when the line is used up.
bool next_field(std::optional<std::string_view>& line, std::string_view& field) {
  if (!line) return false;
  const std::size_t end = line->find(',');
  field = line->substr(0, end);
  if (end == std::string_view::npos) {
    line = std::nullopt;
  } else {
    line->remove_prefix(end + 1);
  }
  return true;
}

class TableReader {
 public:
  explicit TableReader(std::string name) : name_(std::move(name)) {}

  /// False once the table is known to be invalid.
  bool feed(std::string_view bytes) {
    lines_.feed(
        bytes, [this](std::string_view line) { take_line(line); },
        [this] {
          ++line_number_;
          complain("the line is too long; give a table in the UJIIndoorLoc format");
        });
    return !error_;
  }

  core::Result<Rows> finish(const detail::StreamTrouble& trouble) {
    if (!error_ && trouble) complain(*trouble + "; fetch it anew");
    if (!error_ && !lines_.unended().empty()) take_line(lines_.unended());
    if (!error_ && columns_.empty()) complain("the table is empty; give one with a header");
    if (error_) return tl::unexpected(*error_);
    return std::move(rows_);
  }

 private:
  void complain(std::string message) {
    if (error_) return;
    error_ = core::Error{core::ErrorCode::kTableInvalid, std::move(message),
                         name_ + ":" + std::to_string(line_number_)};
  }
  void complain_of(std::size_t column, std::string_view cell, const char* what) {
    complain("column " + std::to_string(column + 1) + " holds \"" +
             std::string(cell.substr(0, kMaxNameLength)) + "\", " + what);
  }

  void take_line(std::string_view line) {
    ++line_number_;
    if (error_ || (line.empty() && !columns_.empty())) return;
    if (columns_.empty()) {
      take_header(line);
    } else {
      take_row(line);
    }
  }
  void take_header(std::string_view line);
  void take_row(std::string_view line);
  bool take_cell(std::size_t column, std::string_view cell, sample::FingerprintRow& row);
  bool take_place(std::size_t column, std::string_view cell, sample::FingerprintRow& row);

  std::string name_;
  detail::LineSplitter lines_;
  std::vector<Column> columns_;
  Rows rows_;
  std::size_t line_number_ = 0;
  std::optional<core::Error> error_;
};

void TableReader::take_header(std::string_view line) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (line.starts_with(kByteOrderMark)) line.remove_prefix(kByteOrderMark.size());
  std::array<bool, kPlaceColumns> is_present{};
  std::vector<std::uint64_t> numbers;
  std::optional<std::string_view> rest = line;
  std::string_view name;
  while (next_field(rest, name)) {
    const auto column = parse_column(name);
    if (!column) return complain_of(columns_.size(), name, "not WAP and a number; correct it");
    if (column->kind == Column::Kind::kTransmitter) numbers.push_back(column->index);
    if (column->kind == Column::Kind::kPlace && std::exchange(is_present[column->index], true)) {
      return complain_of(columns_.size(), name, "which is there already; remove one");
    }
    columns_.push_back(*column);
  }
  for (std::size_t i = 0; i < kPlaceColumns; ++i) {
    if (is_present[i]) continue;
    return complain("no column " + std::string(kPlaceNames[i]) +
                    "; give a table in the UJIIndoorLoc format");
  }
  std::sort(numbers.begin(), numbers.end());
  if (numbers.empty()) return complain("no column WAP1, WAP2, ...; give an UJIIndoorLoc table");
  if (std::adjacent_find(numbers.begin(), numbers.end()) != numbers.end()) {
    complain("two WAP columns of the same number; remove one");
  }
}

void TableReader::take_row(std::string_view line) {
  sample::FingerprintRow row{};
  std::optional<std::string_view> rest = line;
  std::string_view cell;
  std::size_t column = 0;
  for (; next_field(rest, cell); ++column) {
    if (column < columns_.size() && !take_cell(column, cell, row)) return;
  }
  if (column != columns_.size()) {
    return complain(std::to_string(column) + " cells, but the header names " +
                    std::to_string(columns_.size()) + " columns; complete or remove the row");
  }
  rows_.push_back(std::move(row));
}

bool TableReader::take_cell(std::size_t column, std::string_view cell,
                            sample::FingerprintRow& row) {
  const Column& meaning = columns_[column];
  if (meaning.kind == Column::Kind::kOther) return true;
  if (meaning.kind == Column::Kind::kPlace) return take_place(column, cell, row);
  const auto rssi_dbm = detail::parse_number(cell);
  if (!rssi_dbm || (*rssi_dbm != kNotHeard && !detail::is_rssi(*rssi_dbm))) {
    complain_of(column, cell, "not an RSSI in dBm or 100 for not heard; correct it");
    return false;
  }
  if (*rssi_dbm == kNotHeard) return true;
  sample::WifiReading reading;
  reading.transmitter = core::TransmitterId::column(meaning.index);
  reading.rssi_dbm = static_cast<float>(*rssi_dbm);
  row.readings.push_back(std::move(reading));
  return true;
}

bool TableReader::take_place(std::size_t column, std::string_view cell,
                             sample::FingerprintRow& row) {
  const auto place = static_cast<PlaceColumn>(columns_[column].index);
  if (place == kFloor || place == kBuilding) {
    if (cell.empty() || cell.size() > kMaxNameLength) {
      complain_of(column, cell, "not a name; fill it in");
      return false;
    }
    (place == kFloor ? row.floor : row.building) = cell;
    return true;
  }
  const auto coordinate_m = detail::parse_number(cell);
  if (!coordinate_m || std::abs(*coordinate_m) > kMaxProjected_m) {
    complain_of(column, cell, "not a coordinate in metres; correct it");
    return false;
  }
  (place == kLongitude ? row.position_m.x() : row.position_m.y()) = *coordinate_m;
  return true;
}

}  // namespace

core::Result<Rows> read_uji_table(const std::filesystem::path& path) {
  TableReader reader(path.string());
  const auto trouble =
      detail::stream_file(path, [&reader](std::string_view bytes) { return reader.feed(bytes); });
  if (!trouble) return tl::unexpected(trouble.error());
  return reader.finish(*trouble);
}

core::Result<Rows> read_uji_table_bytes(std::string_view bytes, std::string_view name) {
  TableReader reader{std::string(name)};
  const auto trouble =
      detail::stream_bytes(bytes, [&reader](std::string_view chunk) { return reader.feed(chunk); });
  return reader.finish(trouble);
}

}  // namespace waylode::log
