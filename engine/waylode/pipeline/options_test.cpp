// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pipeline/options.hpp"

#include <gtest/gtest.h>

namespace waylode::pipeline {
namespace {

TEST(Options, AreValidByDefault) { EXPECT_TRUE(Options{}.validate()); }

TEST(Options, AreInvalidWhenAnyPartIs) {
  std::vector<Options> bad(9);
  bad[0].scan.max_age_s = -1.0;
  bad[1].matcher.exponent = -1.0F;
  bad[2].wknn.neighbours = 0;
  bad[3].pdr.step_heading_sigma_rad = -1.0;
  bad[4].fused.planar.start_sigma_m = -1.0;
  bad[5].fused.floor.change_probability = 2.0;
  bad[6].fused.state.ok_radius_m = -1.0;
  bad[7].smoothing_rounds = 0;
  bad[8].labels.widest_scale = -1.0;
  for (std::size_t i = 0; i < bad.size(); ++i) {
    const auto valid = bad[i].validate();
    ASSERT_FALSE(valid) << i;
    EXPECT_EQ(valid.error().code, core::ErrorCode::kInvalidOptions) << i;
  }
}

TEST(Options, HandThemselvesOnToSurveyAndSmoothing) {
  Options options;
  options.scan.ble_window_s = 1.5;
  options.pdr.step_length_sigma_ratio = 0.21;
  options.labels.mark_sigma_m = 0.33;
  options.moving.farthest_m = 99.0;
  options.fused.floor.vote_weight = 0.77;
  options.smoothing_rounds = 9;
  EXPECT_EQ(options.survey_options().scan, options.scan);
  EXPECT_EQ(options.survey_options().pdr, options.pdr);
  EXPECT_EQ(options.survey_options().labels, options.labels);
  EXPECT_EQ(options.survey_options().moving, options.moving);
  EXPECT_EQ(options.smoothing_options().fused, options.fused);
  EXPECT_EQ(options.smoothing_options().rounds, 9);
}

}  // namespace
}  // namespace waylode::pipeline
