// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "waylode/core/result.hpp"
#include "waylode/core/time.hpp"

namespace waylode::structure {

/// A straight stretch of one walk: effective displacement. [Zhong2017] 2.7
struct WalkedSegment {
  core::DeviceTime begin;
  core::DeviceTime end;
  double length_m = 0.0;             ///< As measured; the walk's unknown scale is still in it.
  double length_sigma_m = 0.0;       ///< Random part only.
  double direction_rad = 0.0;        ///< Counter-clockwise from +x of the walk's own frame.
  double direction_sigma_rad = 0.0;  ///< Random part only: not the offset of the walk's frame.
  /// Names of the landmarks at the ends, empty where there is none. Where one segment ends the next
  /// begins: one of the two sides may name the landmark, or both the same.
  std::string begin_landmark;
  std::string end_landmark;

  bool operator==(const WalkedSegment&) const = default;
};

/// One person's way, segment after segment without gaps. Heading offset and step scale are unknown
/// but constant.
struct Walk {
  std::vector<WalkedSegment> segments;

  /// The ends of segments in the order they were met: one more than segments, none without any.
  std::size_t visit_count() const { return segments.empty() ? 0 : segments.size() + 1; }
  /// The landmark at a visit; empty when none was named.
  const std::string& landmark_at(std::size_t visit) const;

  bool operator==(const Walk&) const = default;
};

/// The straight distance between two landmarks, measured otherwise (tape, drawing).
struct KnownDistance {
  std::string from;
  std::string to;
  double metres = 0.0;
  double sigma_m = 0.05;

  bool operator==(const KnownDistance&) const = default;
};

/// What is known of a landmark beside its place: a shop's name, a door plate, a photo's file.
struct LandmarkNote {
  std::string landmark;
  std::string text;

  bool operator==(const LandmarkNote&) const = default;
};

/// Everything that goes into one floor's structure.
struct Survey {
  std::vector<Walk> walks;
  std::vector<KnownDistance> known_distances;
  std::vector<LandmarkNote> notes;

  /// kInvalidArgument, with the walk and the segment, for numbers that are not finite, lengths
  /// below zero, sigmas not above zero, ends before begins, two names for one place, distances that
  /// are not above zero or name a landmark no walk has.
  core::Result<void> validate() const;

  bool operator==(const Survey&) const = default;
};

}  // namespace waylode::structure
