// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "waylode/smoothing/whole_track.hpp"

namespace waylode::smoothing {

/// The fused tracker run over a whole track, forwards and back. Scans are weighed again each round,
/// by what the smoothed track makes of them.
class TrackSmoother final : public WholeTrackSmoother {
 public:
  struct Options {
    fusion::FusedTracker::Options fused;
    int rounds = 8;  ///< Passes over the track; the first weighs scans causally.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  TrackSmoother(std::shared_ptr<const site::Site> site, const Options& options,
                std::optional<core::FloorId> known_floor);

 private:
  std::vector<fusion::PlanarEstimate> smooth_path(
      const std::vector<Event>& events, const std::vector<FloorAt>& floors) const override;

  Options options_;
};

}  // namespace waylode::smoothing
