// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "datasets/uji_mag_dataset.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <system_error>

#include "datasets/archive.hpp"
#include "waylode/core/angle.hpp"
#include "waylode/site/tangent_plane.hpp"

namespace waylode::cli {
namespace {

using core::ErrorCode;
using experiment::FieldWalk;

constexpr core::GeoPoint kOrigin{39.9939, -0.0738};

template <typename Number>
bool parse_number(std::string_view text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

/// The text's lines that hold something, with what they hold between blanks.
class LineReader {
 public:
  LineReader(std::string_view text, std::string_view place) : text_(text), place_(place) {}

  /// False at the end of the text.
  bool next() {
    words_.clear();
    while (words_.empty() && !text_.empty()) {
      const std::size_t end = std::min(text_.find('\n'), text_.size());
      split(text_.substr(0, end));
      text_.remove_prefix(std::min(end + 1, text_.size()));
      ++line_;
    }
    return !words_.empty();
  }
  std::span<const std::string_view> words() const { return words_; }

  tl::unexpected<core::Error> refuse(const char* message) const {
    return core::fail(ErrorCode::kTableInvalid, message,
                      std::string(place_) + ":" + std::to_string(line_));
  }

 private:
  void split(std::string_view line) {
    constexpr std::string_view kBlanks = " \t\r";
    for (std::size_t at = line.find_first_not_of(kBlanks); at != std::string_view::npos;
         at = line.find_first_not_of(kBlanks, at)) {
      const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
      words_.push_back(line.substr(at, end - at));
      at = end;
    }
  }

  std::string_view text_;
  std::string_view place_;
  std::size_t line_ = 0;
  std::vector<std::string_view> words_;
};

/// Android's orientation: azimuth from north, pitch down of the top edge, roll, in degrees.
core::Vector3 up_in_device(double pitch_deg, double roll_deg) {
  const double pitch_rad = core::radians_from_degrees(pitch_deg);
  const double roll_rad = core::radians_from_degrees(roll_deg);
  return {-std::sin(roll_rad) * std::cos(pitch_rad), -std::sin(pitch_rad),
          std::cos(roll_rad) * std::cos(pitch_rad)};
}

std::optional<FieldWalk::Reading> parse_reading(std::span<const std::string_view> words) {
  std::int64_t time_ms = 0;
  std::array<double, 9> values{};
  if (words.size() != 1 + values.size() || !parse_number(words[0], time_ms)) return std::nullopt;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!parse_number(words[i + 1], values[i]) || !std::isfinite(values[i])) return std::nullopt;
  }
  FieldWalk::Reading reading;
  reading.time = core::device_time_from_ms(time_ms);
  reading.field_ut = {values[0], values[1], values[2]};
  reading.heading_rad =
      core::wrap_angle(core::heading_from_azimuth(core::radians_from_degrees(values[6])));
  reading.up_in_device = up_in_device(values[7], values[8]);
  return reading;
}

std::optional<FieldWalk::Stretch> parse_stretch(std::span<const std::string_view> words) {
  core::GeoPoint from;
  core::GeoPoint to;
  FieldWalk::Stretch stretch;
  const bool sound =
      words.size() == 6 && parse_number(words[0], from.latitude_deg) &&
      parse_number(words[1], from.longitude_deg) && parse_number(words[2], to.latitude_deg) &&
      parse_number(words[3], to.longitude_deg) && parse_number(words[4], stretch.first) &&
      parse_number(words[5], stretch.last) && site::is_valid_geo_point(from) &&
      site::is_valid_geo_point(to) && stretch.first < stretch.last;
  if (!sound) return std::nullopt;
  stretch.from_m = site::enu_from_geo(kOrigin, from);
  stretch.to_m = site::enu_from_geo(kOrigin, to);
  return stretch;
}

/// The `n` of "<n>"; nullopt for another line. One of its files has "49<2>".
std::optional<std::size_t> parse_count(std::span<const std::string_view> words) {
  if (words.size() != 1 || !words[0].ends_with('>')) return std::nullopt;
  const std::string_view word = words[0];
  const std::size_t open = word.find_first_not_of("0123456789");
  std::size_t count = 0;
  if (word[open] != '<' || !parse_number(word.substr(open + 1, word.size() - open - 2), count)) {
    return std::nullopt;
  }
  return count;
}

core::Result<std::size_t> read_readings(LineReader& lines, FieldWalk& walk) {
  while (lines.next()) {
    if (const auto count = parse_count(lines.words())) return *count;
    const auto reading = parse_reading(lines.words());
    if (!reading) return lines.refuse("need t_ms, 9 numbers, or <n>; mend the line");
    if (!walk.readings.empty() && reading->time <= walk.readings.back().time) {
      return lines.refuse("the time does not go on; sort the lines");
    }
    walk.readings.push_back(*reading);
  }
  return lines.refuse("no <n> and so no truth; the file is cut short");
}

}  // namespace

core::Result<FieldWalk> parse_uji_mag_walk(std::string_view text, std::string_view place) {
  LineReader lines(text, place);
  FieldWalk walk;
  walk.name = std::string(place);
  const auto count = read_readings(lines, walk);
  if (!count) return tl::unexpected(count.error());
  while (lines.next()) {
    auto stretch = parse_stretch(lines.words());
    if (!stretch) return lines.refuse("need lat0 lon0 lat1 lon1 first last; mend the line");
    const bool behind = walk.stretches.empty() || stretch->first > walk.stretches.back().last;
    // Ten of its files end one reading after their last.
    if (stretch->last == walk.readings.size() && stretch->first + 1 < stretch->last)
      --stretch->last;
    if (!behind || stretch->last >= walk.readings.size()) {
      return lines.refuse("the stretch overlaps the one before or ends after the readings");
    }
    walk.stretches.push_back(*stretch);
  }
  if (walk.stretches.empty() || walk.stretches.size() != *count) {
    return lines.refuse("not as many stretches as <n> says; the file is cut short");
  }
  return walk;
}

core::Result<UjiMagDataset> load_uji_mag_dataset(const std::filesystem::path& archive) {
  const auto files = read_archive(archive);
  if (!files) return tl::unexpected(files.error());
  UjiMagDataset dataset;
  for (const auto& [name, text] : *files) {
    const bool test = name.find("/tests/") != std::string::npos;
    const bool training =
        name.find("/lines/") != std::string::npos || name.find("/curves/") != std::string::npos;
    if (!name.ends_with(".txt") || (!test && !training)) continue;
    auto walk = parse_uji_mag_walk(text, name);
    if (!walk) return tl::unexpected(walk.error());
    (test ? dataset.tests : dataset.training).push_back(*std::move(walk));
  }
  if (dataset.training.empty() || dataset.tests.empty()) {
    return core::fail(ErrorCode::kLogLacksRecords,
                      "no walks under lines/ or curves/, or none under tests/; give the archive of "
                      "UJIIndoorLoc-Mag",
                      archive.string());
  }
  return dataset;
}

}  // namespace waylode::cli
