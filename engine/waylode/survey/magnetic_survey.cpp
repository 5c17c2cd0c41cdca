// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/survey/magnetic_survey.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "waylode/magnetic/features.hpp"

namespace waylode::survey {
namespace {

using core::Vector2;

/// Walks that share fewer cells than this with others keep most of their own field.
constexpr double kCellsOfTrust = 10.0;
constexpr int kRounds = 20;
/// Cells are wider here than in the map, so that walks side by side meet.
constexpr double kMeeting_m = 1.0;

/// Averages the field until the walk has gone on by one spacing.
class Piece {
 public:
  void add(const Label& label, const Vector2& field_ut) {
    if (count_ == 0) first_ = label;
    ++count_;
    position_sum_m_ += label.position_m;
    field_sum_ut_ += field_ut;
  }
  bool empty() const { return count_ == 0; }
  bool takes(const Label& label, double spacing_m) const {
    return empty() || (label.floor == first_.floor &&
                       (label.position_m - first_.position_m).norm() < spacing_m);
  }
  core::FloorId floor() const { return first_.floor; }
  Vector2 position_m() const { return position_sum_m_ / count_; }
  Vector2 field_ut() const { return field_sum_ut_ / count_; }

 private:
  double count_ = 0.0;
  Label first_;
  Vector2 position_sum_m_ = Vector2::Zero();
  Vector2 field_sum_ut_ = Vector2::Zero();
};

/// floor, row, column.
using MeetingPlace = std::tuple<std::uint16_t, double, double>;

MeetingPlace meeting_place(core::FloorId floor, const Vector2& position_m) {
  return {floor.index, std::floor(position_m.y() / kMeeting_m),
          std::floor(position_m.x() / kMeeting_m)};
}

struct Mean {
  double count = 0.0;
  Vector2 sum_ut = Vector2::Zero();

  void add(const Vector2& field_ut) {
    ++count;
    sum_ut += field_ut;
  }
  Vector2 value_ut() const { return sum_ut / count; }
};

using MeansOfWalk = std::map<MeetingPlace, Mean>;

/// How far a walk is from the others where they meet, drawn to zero where they hardly do. `all`
/// holds the walk's own voice less its `present_ut` offset.
Vector2 offset_against_others(const MeansOfWalk& own, const MeansOfWalk& all,
                              const Vector2& present_ut) {
  Mean apart;
  for (const auto& [place, mean] : own) {
    const Mean& here = all.at(place);
    if (here.count < 2.0) continue;
    const Vector2 others_ut = (here.sum_ut - (mean.value_ut() - present_ut)) / (here.count - 1.0);
    apart.add(mean.value_ut() - others_ut);
  }
  return apart.sum_ut / (apart.count + kCellsOfTrust);
}

}  // namespace

core::Result<void> MagneticSurvey::Options::validate() const {
  if (!(spacing_m >= 0.05 && spacing_m <= 10.0)) {
    return core::fail(core::ErrorCode::kInvalidOptions, "spacing_m must be from 0.05 to 10",
                      "magnetic_survey");
  }
  if (const auto valid = cells.validate(); !valid) return valid;
  return gravity.validate();
}

std::vector<MagneticSurvey::Reading> MagneticSurvey::readings_of(
    std::span<const sample::Sample> samples, const LabelledPath& path, const Options& options) {
  Walk walk;
  Piece piece;
  const auto finish = [&] {
    if (!piece.empty()) walk.push_back({piece.floor(), piece.position_m(), piece.field_ut()});
    piece = Piece();
  };
  pdr::GravityFilter gravity(options.gravity);
  for (const sample::Sample& each : samples) {
    if (const auto* force = std::get_if<sample::AccelerometerSample>(&each)) {
      gravity.add(*force);
    } else if (const auto* rate = std::get_if<sample::GyroscopeSample>(&each)) {
      gravity.add(*rate);
    } else if (const auto* field = std::get_if<sample::MagnetometerSample>(&each)) {
      if (!gravity.up_in_device()) continue;
      const auto level = magnetic::level_field(field->field_ut, *gravity.up_in_device());
      const auto label = path.at(field->time);
      if (!level || !label) continue;
      if (!piece.takes(*label, options.spacing_m)) finish();
      piece.add(*label, Vector2(level->horizontal_ut, level->vertical_ut));
    }
  }
  finish();
  return walk;
}

void MagneticSurvey::add(std::span<const sample::Sample> samples, const LabelledPath& path) {
  if (options_.build) walks_.push_back(readings_of(samples, path, options_));
}

std::vector<Vector2> MagneticSurvey::learn_offsets() const {
  std::vector<MeansOfWalk> own(walks_.size());
  MeansOfWalk all;  // Of every place, each walk with one voice.
  for (std::size_t i = 0; i < walks_.size(); ++i) {
    for (const Reading& reading : walks_[i]) {
      own[i][meeting_place(reading.floor, reading.position_m)].add(reading.field_ut);
    }
    for (const auto& [place, mean] : own[i]) all[place].add(mean.value_ut());
  }
  std::vector<Vector2> offsets_ut(walks_.size(), Vector2::Zero());
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < own.size(); ++i) {
      const Vector2 offset_ut = offset_against_others(own[i], all, offsets_ut[i]);
      for (const auto& [place, mean] : own[i]) all.at(place).sum_ut += offsets_ut[i] - offset_ut;
      offsets_ut[i] = offset_ut;
    }
  }
  return offsets_ut;
}

site::MagneticMapStorage MagneticSurvey::build() const {
  std::vector<Vector2> offsets_ut(walks_.size(), Vector2::Zero());
  if (options_.align_walks) offsets_ut = learn_offsets();
  site::MagneticMapBuilder builder(options_.cells);
  for (std::size_t i = 0; i < walks_.size(); ++i) {
    for (const Reading& reading : walks_[i]) {
      const Vector2 field_ut = reading.field_ut - offsets_ut[i];
      builder.add(reading.floor, reading.position_m, std::max(0.0, field_ut.x()), field_ut.y());
    }
  }
  return builder.build();
}

}  // namespace waylode::survey
