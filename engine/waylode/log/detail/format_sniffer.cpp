// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/detail/format_sniffer.hpp"

#include <algorithm>

#include "waylode/log/detail/getsensordata_records.hpp"

namespace waylode::log::detail {
namespace {

constexpr std::string_view kMcapMagic = "\x89MCAP0\r\n";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

bool is_ilc_record(std::string_view line) {
  const std::size_t digits = line.find_first_not_of("0123456789");
  return digits != 0 && digits != std::string_view::npos &&
         line.substr(digits).starts_with("\tTYPE_");
}

std::optional<LogFormat> format_of_record(std::string_view line) {
  if (is_ilc_record(line)) return LogFormat::kIlc;
  const std::size_t type_end = line.find(';');
  if (type_end != std::string_view::npos && is_getsensordata_type(line.substr(0, type_end))) {
    return LogFormat::kGetSensorData;
  }
  return std::nullopt;
}

std::optional<LogFormat> format_of_header(std::string_view line) {
  if (line.starts_with("#\tstartTime:")) return LogFormat::kIlc;
  if (line.starts_with('%') && line.find("GetSensorData") != std::string_view::npos) {
    return LogFormat::kGetSensorData;
  }
  return std::nullopt;
}

}  // namespace

std::optional<LogFormat> sniff_format(std::string_view head) {
  if (head.starts_with(kMcapMagic)) return LogFormat::kMcap;
  if (head.starts_with(kByteOrderMark)) head.remove_prefix(kByteOrderMark.size());
  std::optional<LogFormat> by_header;
  while (!head.empty()) {
    const std::size_t end = std::min(head.find('\n'), head.size());
    const std::string_view line = head.substr(0, end);
    if (const auto format = format_of_record(line)) return format;
    if (!by_header) by_header = format_of_header(line);
    head.remove_prefix(std::min(end + 1, head.size()));
  }
  return by_header;
}

}  // namespace waylode::log::detail
