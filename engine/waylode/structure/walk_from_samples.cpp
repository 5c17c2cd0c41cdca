// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/structure/walk_from_samples.hpp"

#include <vector>

namespace waylode::structure {

core::Result<Walk> walk_from_samples(std::span<const sample::Sample> samples,
                                     std::span<const LandmarkMark> marks,
                                     const pdr::DeadReckoning::Options& pdr_options,
                                     const SegmentationOptions& options) {
  if (auto checked = pdr_options.validate(); !checked) return tl::unexpected(checked.error());
  pdr::DeadReckoning reckoning(pdr_options);
  std::vector<observation::MotionDelta> motion;
  for (const sample::Sample& sample : samples) {
    if (const auto delta = reckoning.add(sample)) motion.push_back(*delta);
  }
  return walk_from_motion(motion, marks, options);
}

}  // namespace waylode::structure
