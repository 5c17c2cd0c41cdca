// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "datasets/csv.hpp"

#include <algorithm>

namespace waylode::cli {
namespace {

/// Takes one cell off the text at a time.
class CellReader {
 public:
  CellReader(std::string_view text, std::string_view place) : text_(text), place_(place) {}

  bool at_end() const { return text_.empty(); }
  std::size_t line() const { return line_; }

  core::Result<std::string> take_cell() {
    if (text_.starts_with('"')) return take_quoted();
    const std::size_t end = std::min(text_.find_first_of(",\r\n\""), text_.size());
    if (end < text_.size() && text_[end] == '"') {
      return refuse(line_, "a quote inside a bare cell; put the cell in quotes and double it");
    }
    std::string cell(text_.substr(0, end));
    text_.remove_prefix(end);
    return cell;
  }

  /// Takes what parts two cells; false when the row ends here.
  core::Result<bool> take_comma() {
    if (take(",")) return true;
    if (take("\r\n") || take("\n") || take("\r")) {
      ++line_;
      return false;
    }
    if (at_end()) return false;
    return refuse(line_, "text after a closing quote; write a comma");
  }

 private:
  bool take(std::string_view expected) {
    if (!text_.starts_with(expected)) return false;
    text_.remove_prefix(expected.size());
    return true;
  }

  core::Result<std::string> take_quoted() {
    const std::size_t opened_line = line_;
    std::string cell;
    text_.remove_prefix(1);
    while (!text_.empty()) {
      if (take("\"\"")) {
        cell += '"';
        continue;
      }
      if (take("\"")) return cell;
      if (text_.front() == '\n') ++line_;
      cell += text_.front();
      text_.remove_prefix(1);
    }
    return refuse(opened_line, "a quote is opened and never closed; close it");
  }

  tl::unexpected<core::Error> refuse(std::size_t line, const char* message) const {
    return core::fail(core::ErrorCode::kTableInvalid, message,
                      std::string(place_) + ":" + std::to_string(line));
  }

  std::string_view text_;
  std::string_view place_;
  std::size_t line_ = 1;
};

}  // namespace

core::Result<std::vector<CsvRow>> parse_csv(std::string_view text, std::string_view place) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  std::vector<CsvRow> rows;
  CellReader reader(text, place);
  while (!reader.at_end()) {
    CsvRow row{reader.line(), {}};
    for (bool more = true; more;) {
      auto cell = reader.take_cell();
      if (!cell) return tl::unexpected(cell.error());
      row.cells.push_back(*std::move(cell));
      const auto comma = reader.take_comma();
      if (!comma) return tl::unexpected(comma.error());
      more = *comma;
    }
    const bool blank = row.cells.size() == 1 && row.cells.front().empty();
    if (!blank) rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace waylode::cli
