// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/particle_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "waylode/fusion/testing/particle_model.hpp"
#include "waylode/fusion/testing/planar_model.hpp"

namespace waylode::fusion {
namespace {

using core::Vector2;
using testing::at_s;
using testing::gaussian_raster;
using testing::moments_of;
using testing::open_ground;
using testing::particle_options;
using testing::raster_scan;
using testing::step_of;

TEST(ParticleFilter, StraightWalksSpreadAsTheClosedFormSays) {
  ParticleFilter::Options options = particle_options();
  options.particles = 40000;
  options.heading_offset_sigma_rad = 0.2;
  options.log_scale_sigma = 0.1;
  ParticleFilter filter(options, 3, /*keep_history=*/false);
  filter.start(at_s(0.0), Vector2(3.0, -7.0), 0.5);
  constexpr int kSteps = 30;
  for (int i = 0; i < kSteps; ++i) {
    filter.add(step_of(0.5 * i, 0.5 * (i + 1), 0.8, 0.0, 0.1, 0.0), open_ground());
  }
  // x = 24 e^s cos(h), y = 24 e^s sin(h), s and h Gaussian: E e^s = exp(0.005),
  // E e^2s = exp(0.02), E cos h = exp(-0.02), E cos^2 h = (1 + exp(-0.08)) / 2. The steps' own
  // lengths add 30 * 0.1^2 E e^2s along the heading, the start 0.5^2 and time 0.01^2 * 15 s.
  const double mean_x_m = 24.0 * std::exp(0.005 - 0.02);
  const double cos_square = 0.5 * (1.0 + std::exp(-0.08));
  const double along_m2 = (24.0 * 24.0 + kSteps * 0.01) * std::exp(0.02);
  const double around_m2 = 0.25 + 15.0 * 0.0001;
  const auto moments = moments_of(filter);
  EXPECT_NEAR(moments.mean_m.x(), 3.0 + mean_x_m, 0.06);
  EXPECT_NEAR(moments.mean_m.y(), -7.0, 0.12);
  EXPECT_NEAR(moments.covariance_m2(0, 0), along_m2 * cos_square - mean_x_m * mean_x_m + around_m2,
              0.25);
  EXPECT_NEAR(moments.covariance_m2(1, 1), along_m2 * (1.0 - cos_square) + around_m2, 0.8);
}

TEST(ParticleFilter, ARoundTripUndoesWhatOffsetAndScaleDid) {
  ParticleFilter::Options options = particle_options();
  options.heading_offset_sigma_rad = 0.5;
  options.log_scale_sigma = 0.2;
  ParticleFilter filter(options, 4, /*keep_history=*/false);
  filter.start(at_s(0.0), Vector2(1.0, 2.0), 0.01);
  for (int i = 0; i < 4; ++i) {
    filter.add(step_of(i, i + 1.0, 5.0, 0.3 + 1.5707963267948966 * i, 0.0, 0.0), open_ground());
  }
  // Only the start and the walk of 4 s are left: 0.01^2 + 0.01^2 * 4.
  const auto moments = moments_of(filter);
  EXPECT_LT((moments.mean_m - Vector2(1.0, 2.0)).norm(), 0.003);
  EXPECT_NEAR(moments.covariance_m2(0, 0), 5e-4, 6e-5);
  EXPECT_NEAR(moments.covariance_m2(1, 1), 5e-4, 6e-5);
}

TEST(ParticleFilter, AScanCombinesWithThePriorAsKalmanSays) {
  ParticleFilter::Options options = particle_options();
  options.particles = 40000;
  ParticleFilter filter(options, 5, /*keep_history=*/false);
  filter.start(at_s(0.0), Vector2(1.0, 2.0), 3.0);
  filter.add(raster_scan(0.0, gaussian_raster(Vector2(5.0, -1.0), 4.0)), open_ground());
  // Gain 9 / (9 + 16): 1 + 0.36 * 4, 2 - 0.36 * 3; variance 9 * 16 / 25.
  const auto moments = moments_of(filter);
  EXPECT_NEAR(moments.mean_m.x(), 2.44, 0.07);
  EXPECT_NEAR(moments.mean_m.y(), 0.92, 0.07);
  EXPECT_NEAR(moments.covariance_m2(0, 0), 5.76, 0.3);
  EXPECT_NEAR(moments.covariance_m2(1, 1), 5.76, 0.3);
  EXPECT_NEAR(moments.covariance_m2(0, 1), 0.0, 0.2);
}

TEST(ParticleFilter, TrustIsAPowerOnTheLikelihood) {
  ParticleFilter::Options options = particle_options();
  options.particles = 40000;
  options.radio_trust = 0.25;
  ParticleFilter filter(options, 5, /*keep_history=*/false);
  filter.start(at_s(0.0), Vector2(1.0, 2.0), 3.0);
  filter.add(raster_scan(0.0, gaussian_raster(Vector2(5.0, -1.0), 4.0)), open_ground());
  // As a scan of sigma 8: gain 9 / 73.
  EXPECT_NEAR(moments_of(filter).mean_m.x(), 1.0 + 4.0 * 9.0 / 73.0, 0.07);
  EXPECT_NEAR(moments_of(filter).covariance_m2(0, 0), 9.0 * 64.0 / 73.0, 0.3);
}

TEST(ParticleFilter, ALateScanTellsOfWhereTheWalkerWas) {
  ParticleFilter::Options options = particle_options();
  options.particles = 40000;
  ParticleFilter filter(options, 6, /*keep_history=*/false);
  filter.start(at_s(0.0), Vector2::Zero(), 3.0);
  for (int i = 0; i < 4; ++i) {
    filter.add(step_of(i, i + 1.0, 2.0, 0.0, 0.0, 0.0), open_ground());
  }
  // Measured after 2.5 steps, that is 3 m before the place of now, which is (8, 0).
  filter.add(raster_scan(4.0, gaussian_raster(Vector2(9.0, 1.0), 4.0), /*delay_s=*/1.5),
             open_ground());
  EXPECT_NEAR(moments_of(filter).mean_m.x(), 8.0 + 0.36 * 4.0, 0.08);
  EXPECT_NEAR(moments_of(filter).mean_m.y(), 0.36, 0.08);
}

TEST(ParticleFilter, RepeatedScansOfOneErrorLeaveTheBiasInDoubt) {
  ParticleFilter::Options options = particle_options();
  options.particles = 60000;
  options.radio_bias_sigma_m = 3.0;
  options.radio_bias_tau_s = 1e9;  // The same error for ever.
  ParticleFilter filter(options, 7, /*keep_history=*/false);
  filter.start(at_s(0.0), Vector2::Zero(), 4.0);
  const auto raster = gaussian_raster(Vector2(5.0, 0.0), 3.0);
  for (int i = 0; i < 9; ++i) filter.add(raster_scan(0.0, raster), open_ground());
  // Nine scans of sigma 3 are one of sigma 1, of place and bias together: 9 + 1 per axis.
  const auto moments = moments_of(filter);
  EXPECT_NEAR(moments.mean_m.x(), 5.0 * 16.0 / 26.0, 0.25);
  EXPECT_NEAR(moments.covariance_m2(0, 0), 16.0 * 10.0 / 26.0, 0.8);
  EXPECT_NEAR(moments.covariance_m2(1, 1), 16.0 * 10.0 / 26.0, 0.8);
}

std::size_t drawn_anew(const ParticleFilter& filter) {
  return static_cast<std::size_t>(
      std::ranges::count(filter.history().back().parents, ParticleFilter::kNoParent));
}

TEST(ParticleFilter, RedrawsAsManyAsBayesRuleSays) {
  ParticleFilter::Options options = particle_options();
  options.particles = 10000;
  options.jump_probability = 0.1;
  ParticleFilter filter(options, 8, /*keep_history=*/true);
  filter.start(at_s(0.0), Vector2::Zero(), 0.01);
  // Log-likelihood -2 all around the guesses, 0 in 3 of 12 nodes far off.
  observation::LikelihoodRaster raster;
  raster.origin_m = Vector2(-20.0, -20.0);
  raster.node_m = 20.0;
  raster.columns = 4;
  raster.rows = 3;
  raster.log_likelihood.assign(12, -2.0F);
  raster.log_likelihood[3] = raster.log_likelihood[7] = raster.log_likelihood[11] = 0.0F;
  filter.add(raster_scan(0.0, raster), open_ground());
  const double anywhere = (3.0 + 9.0 * std::exp(-2.0)) / 12.0;
  const double jumped = 0.1 * anywhere / (0.1 * anywhere + 0.9 * std::exp(-2.0));
  EXPECT_NEAR(static_cast<double>(drawn_anew(filter)), 10000.0 * jumped, 10.0);
  const auto far = std::ranges::count_if(
      filter.particles(), [](const Particle& particle) { return particle.position_m.x() >= 30.0; });
  const double share = 3.0 / (3.0 + 9.0 * std::exp(-2.0));
  EXPECT_NEAR(static_cast<double>(far), 10000.0 * jumped * share, 200.0);
}

TEST(ParticleFilter, NobodyIsCarriedOffWithoutAJumpProbability) {
  ParticleFilter filter(particle_options(), 9, /*keep_history=*/true);
  filter.start(at_s(0.0), Vector2::Zero(), 2.0);
  for (int i = 1; i <= 10; ++i) {
    // Likelihoods at the guesses are below what a double holds.
    filter.add(raster_scan(i, gaussian_raster(Vector2(90.0, 90.0), 1.0)), open_ground());
    EXPECT_EQ(drawn_anew(filter), 0U);
  }
  EXPECT_LT(filter.at(at_s(10.0)).position_m.norm(), 15.0);
  EXPECT_TRUE(filter.at(at_s(10.0)).covariance_m2.allFinite());
}

TEST(ParticleFilter, AWrongStartIsLeftWithinAFewScans) {
  ParticleFilter::Options options = particle_options();
  options.particles = 1000;
  options.radio_bias_sigma_m = 2.0;
  options.radio_bias_tau_s = 30.0;
  options.jump_probability = 0.01;
  const Vector2 truth_m(30.0, 40.0);
  int left = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    core::Rng rng(seed);
    ParticleFilter filter(options, seed, /*keep_history=*/false);
    filter.start(at_s(0.0), Vector2::Zero(), 2.0);
    for (int i = 1; i <= 7; ++i) {
      const Vector2 error_m(rng.normal(0.0, 4.0), rng.normal(0.0, 4.0));
      filter.add(raster_scan(2.0 * i, gaussian_raster(truth_m + error_m, 4.0)), open_ground());
    }
    if ((filter.at(at_s(14.0)).position_m - truth_m).norm() < 8.0) ++left;
  }
  EXPECT_GE(left, 190);
}

TEST(ParticleFilter, ImpossibleScansLeaveTheGuessesAlone) {
  for (const double jump_probability : {0.0, 0.01}) {
    ParticleFilter::Options options = particle_options();
    options.jump_probability = jump_probability;
    ParticleFilter filter(options, 10, /*keep_history=*/true);
    filter.start(at_s(0.0), Vector2(1.0, 2.0), 2.0);
    observation::LikelihoodRaster raster = gaussian_raster(Vector2::Zero(), 4.0);
    std::ranges::fill(raster.log_likelihood, -1e6F);
    raster.elsewhere = -1e6F;
    filter.add(raster_scan(1.0, raster), open_ground());
    // No place fits better than another: the prior share is redrawn, no more.
    EXPECT_EQ(static_cast<double>(drawn_anew(filter)),
              std::round(jump_probability * static_cast<double>(options.particles)));
    EXPECT_LT((filter.at(at_s(1.0)).position_m - Vector2(1.0, 2.0)).norm(), 0.3);
  }
}

TEST(ParticleFilter, PassesOverStepsThatAreNotSound) {
  ParticleFilter filter(particle_options(), 11, /*keep_history=*/false);
  filter.start(at_s(0.0), Vector2::Zero(), 2.0);
  filter.add(step_of(1.0, 2.0, 0.7, 0.4), open_ground());
  const PlanarEstimate before = filter.at(at_s(2.0));
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    filter.add(step_of(2.0, 3.0, bad, 0.4), open_ground());
    filter.add(step_of(2.0, 3.0, 0.7, bad), open_ground());
    filter.add(step_of(2.0, 3.0, 0.7, 0.4, bad), open_ground());
    filter.add(step_of(2.0, 3.0, 0.7, 0.4, 0.05, bad), open_ground());
  }
  filter.add(step_of(2.0, 3.0, -0.7, 0.4), open_ground());
  filter.add(step_of(3.0, 2.0, 0.7, 0.4), open_ground());  // Ends before it begins.
  filter.add(step_of(0.5, 1.5, 0.7, 0.4), open_ground());  // Out of order.
  EXPECT_EQ(filter.at(at_s(2.0)), before);
}

TEST(ParticleFilter, BearsRastersOfOneNodeAndTheWidestGaps) {
  ParticleFilter::Options options = particle_options();
  options.jump_probability = 0.01;
  ParticleFilter filter(options, 12, /*keep_history=*/true);
  observation::LikelihoodRaster raster;
  raster.origin_m = Vector2(4.0, 6.0);
  raster.columns = raster.rows = 1;
  raster.log_likelihood = {-1.0F};
  raster.elsewhere = -1.0F;
  filter.add(raster_scan(1.0, raster), open_ground());
  ASSERT_TRUE(filter.started());
  // Uniform over the node's square of 2 m.
  EXPECT_LT((filter.at(at_s(1.0)).position_m - Vector2(4.0, 6.0)).norm(), 0.2);
  filter.add(step_of(1e9, 1e9 + 1.0, 0.7, 0.0), open_ground());
  filter.add(raster_scan(1e9 + 2.0, raster), open_ground());
  EXPECT_TRUE(filter.at(at_s(2e9)).position_m.allFinite());
  EXPECT_TRUE(filter.at(at_s(2e9)).covariance_m2.allFinite());
}

ParticleFilter walked(std::uint64_t seed) {
  ParticleFilter::Options options = particle_options();
  options.particles = 1000;
  options.jump_probability = 0.01;
  options.radio_bias_sigma_m = 2.0;
  ParticleFilter filter(options, seed, /*keep_history=*/false);
  for (int i = 0; i < 40; ++i) {
    filter.add(step_of(0.5 * i, 0.5 * (i + 1), 0.7, 0.1), open_ground());
    if (i % 4 == 0) {
      filter.add(raster_scan(0.5 * (i + 1), gaussian_raster(Vector2(0.7 * i, 3.0), 4.0)),
                 open_ground());
    }
  }
  return filter;
}

TEST(ParticleFilter, SameSeedSameBytesOtherSeedSamePlace) {
  const ParticleFilter first = walked(1);
  const ParticleFilter again = walked(1);
  const ParticleFilter other = walked(2);
  EXPECT_EQ(first.weights(), again.weights());
  for (std::size_t i = 0; i < first.particles().size(); ++i) {
    EXPECT_EQ(first.particles()[i].position_m, again.particles()[i].position_m);
    EXPECT_EQ(first.particles()[i].radio_bias_m, again.particles()[i].radio_bias_m);
  }
  EXPECT_NE(first.particles()[0].position_m, other.particles()[0].position_m);
  EXPECT_LT((first.at(at_s(20.0)).position_m - other.at(at_s(20.0)).position_m).norm(), 1.0);
}

TEST(ParticleFilter, AWallDrawnInErrorDoesNotHoldAWalker) {
  site::Plan plan;
  plan.walls.push_back({Vector2(10.0, -50.0), Vector2(10.0, 50.0)});
  const site::Walkability walkability(plan, {Vector2(-50.0, -50.0), Vector2(50.0, 50.0)},
                                      {.cell_m = 0.5});
  Ground ground = open_ground();
  ground.walkability = &walkability;
  ParticleFilter::Options options = particle_options();
  options.particles = 1000;
  options.plan_trust = 1.0;
  options.jump_probability = 0.01;
  options.position_walk_m_per_sqrt_s = 0.2;
  ParticleFilter filter(options, 13, /*keep_history=*/false);
  filter.start(at_s(0.0), Vector2::Zero(), 1.0);
  for (int i = 1; i <= 30; ++i) {
    filter.add(step_of(i - 1.0, i, 0.8, 0.0), ground);
    if (i % 3 == 0) filter.add(raster_scan(i, gaussian_raster({0.8 * i, 0.0}, 3.0)), ground);
    EXPECT_LT((filter.at(at_s(i)).position_m - Vector2(0.8 * i, 0.0)).norm(), 3.5) << i;
  }
}

/// A field whose vertical part rises by 0.5 uT per metre eastwards, surveyed on a fine grid.
magnetic::FieldLikelihood rising_field() {
  std::vector<site::MagneticPoint> points;
  for (int row = -10; row <= 10; ++row) {
    for (int column = -60; column <= 60; ++column) {
      const auto x_m = static_cast<float>(0.5 * column);
      points.push_back(
          {x_m, static_cast<float>(0.5 * row), 20.0F, -40.0F + 0.5F * x_m, 1.0F, 0, 9});
    }
  }
  return {points, {}};
}

observation::MotionDelta felt(observation::MotionDelta step, double vertical_ut) {
  step.level_field_ut = Vector2(20.0, vertical_ut);
  return step;
}

TEST(ParticleFilter, TheFieldAlongAStepWeighsEachGuessByItsOwnPath) {
  ParticleFilter::Options options = particle_options();
  options.resample_ratio = 0.0;
  options.position_walk_m_per_sqrt_s = 1e-9;
  const magnetic::FieldLikelihood field = rising_field();
  Ground ground = open_ground();
  ground.field = &field;
  ParticleFilter filter(options, 8, /*keep_history=*/false);
  filter.start(at_s(0.0), Vector2(2.0, 0.0), 4.0);
  filter.add(felt(step_of(0.0, 0.5, 0.8, 0.0, 0.0, 0.0), -33.0), ground);
  const auto expected = [&](std::size_t i) {
    magnetic::BiasedFieldState bias = field.start();
    const Vector2 midway_m = filter.particles()[i].position_m - Vector2(0.4, 0.0);
    return field.update(bias, {20.0, -33.0}, midway_m, 0.8);
  };
  double spread = 0.0;
  for (std::size_t i = 1; i < filter.particles().size(); ++i) {
    const double ratio = std::log(filter.weights()[i] / filter.weights()[0]);
    EXPECT_NEAR(ratio, expected(i) - expected(0), 1e-5);
    spread = std::max(spread, std::abs(ratio));
    EXPECT_TRUE(filter.particles()[i].field_bias);
  }
  EXPECT_GT(spread, 0.1);  // The field did tell them apart.
}

TEST(ParticleFilter, TheShapeOfTheFieldPlacesAWalkerWhosePhoneHasAConstantError) {
  // A bump at x = 10 on an even field; the phone reads 6 uT too much everywhere.
  std::vector<site::MagneticPoint> points;
  const auto truth_ut = [](double x_m) {
    return -40.0 + 25.0 * std::exp(-0.5 * std::pow((x_m - 10.0) / 1.5, 2));
  };
  for (int column = -60; column <= 80; ++column) {
    const double x_m = 0.5 * column;
    points.push_back(
        {static_cast<float>(x_m), 0.0F, 20.0F, static_cast<float>(truth_ut(x_m)), 1.0F, 0, 9});
  }
  const magnetic::FieldLikelihood field(points, {});
  const auto error_m = [&](const magnetic::FieldLikelihood* known) {
    ParticleFilter::Options options = particle_options();
    options.heading_offset_sigma_rad = 0.02;
    options.position_walk_m_per_sqrt_s = 0.1;
    Ground ground = open_ground();
    ground.field = known;
    ParticleFilter filter(options, 8, /*keep_history=*/false);
    filter.start(at_s(0.0), Vector2(3.0, 0.0), 2.0);  // 3 m ahead of the truth.
    for (int i = 0; i < 25; ++i) {
      const double midway_m = 0.8 * (i + 0.5);
      filter.add(felt(step_of(0.5 * i, 0.5 * (i + 1), 0.8, 0.0, 0.02), truth_ut(midway_m) + 6.0),
                 ground);
    }
    return std::abs(filter.at(at_s(12.5)).position_m.x() - 20.0);
  };
  EXPECT_GT(error_m(nullptr), 2.0);
  EXPECT_LT(error_m(&field), 1.0);
}

TEST(ParticleFilter, AFieldThatIsNotFeltOrNotKnownChangesNothing) {
  const magnetic::FieldLikelihood field = rising_field();
  Ground known = open_ground();
  known.field = &field;
  const auto walk = [](const Ground& ground, bool feels) {
    ParticleFilter filter(particle_options(), 8, /*keep_history=*/false);
    filter.start(at_s(0.0), Vector2::Zero(), 2.0);
    const auto step = step_of(0.0, 0.5, 0.8, 0.0);
    filter.add(feels ? felt(step, -39.0) : step, ground);
    return filter;
  };
  const ParticleFilter plain = walk(open_ground(), false);
  for (const ParticleFilter& same : {walk(known, false), walk(open_ground(), true)}) {
    EXPECT_EQ(same.weights(), plain.weights());
    EXPECT_EQ(same.particles()[7].position_m, plain.particles()[7].position_m);
    EXPECT_FALSE(same.particles()[7].field_bias);
  }
  EXPECT_NE(walk(known, true).weights(), plain.weights());
}

TEST(SpatialMedian, IsThePlaceOfLeastMeanDistance) {
  // Fermat's point of a right triangle with legs 6: on the diagonal, where the legs' ends are seen
  // under 120 degrees, 3 sqrt 2 / tan 60 degrees from the middle between them.
  const double on_axis_m = 3.0 * (1.0 - 1.0 / std::sqrt(3.0));
  const std::vector<Vector2> places = {{0.0, 0.0}, {6.0, 0.0}, {0.0, 6.0}};
  const Vector2 median = spatial_median(places, {1.0, 1.0, 1.0}, {2.0, 2.0});
  EXPECT_NEAR(median.x(), on_axis_m, 0.02);
  EXPECT_NEAR(median.y(), on_axis_m, 0.02);
  // Who has more than half of the weight has the median.
  EXPECT_LT((spatial_median(places, {1.0, 9.0, 1.0}, {2.0, 2.0}) - places[1]).norm(), 0.1);
  EXPECT_EQ(spatial_median({{3.0, 4.0}}, {1.0}, {3.0, 4.0}), Vector2(3.0, 4.0));
}

}  // namespace
}  // namespace waylode::fusion
