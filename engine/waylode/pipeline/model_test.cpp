// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pipeline/model.hpp"

#include <gtest/gtest.h>

#include <array>
#include <thread>

#include "waylode/pipeline/testing/tiny_site.hpp"

namespace waylode::pipeline {
namespace {

using testing::Field;
using testing::tiny_model;

constexpr std::array kRadioParts = {RadioPart::kWknn,
                                    RadioPart::kKnn,
                                    RadioPart::kRegionWknn,
                                    RadioPart::kWindowKnn,
                                    RadioPart::kRelevanceVectors,
                                    RadioPart::kSupportVectors};

radio::Query query_at(core::FloorId floor, const core::Vector2& place_m) {
  return radio::ScanAssembler(radio::ScanAssembler::Options())
      .assemble(testing::scan_at(1.0, floor, place_m));
}

TEST(Model, NeedsARadioMap) {
  const auto site = std::make_shared<const site::Site>(testing::tiny_floors());
  const auto model = Model::create(site, testing::tiny_options());
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error().code, core::ErrorCode::kMapMissing);
  EXPECT_EQ(model.error().place, "tiny");
}

TEST(Model, RejectsOptionsThatMakeNoSense) {
  Options options = testing::tiny_options();
  options.fused.planar.radio_bias_tau_s = 0.0;
  const auto model = Model::create(testing::tiny_site(), options);
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error().code, core::ErrorCode::kInvalidOptions);
}

TEST(Model, MakesEveryWayToPlaceScansOnce) {
  const auto model = tiny_model();
  std::vector<const radio::Positioner*> made;
  for (const RadioPart part : kRadioParts) {
    const auto positioner = model->positioner(part);
    ASSERT_TRUE(positioner) << positioner.error().message;
    EXPECT_EQ(*model->positioner(part), *positioner);
    for (const radio::Positioner* other : made) EXPECT_NE(positioner->get(), other);
    made.push_back(positioner->get());
  }
  EXPECT_EQ(*model->near_positioner(), *model->near_positioner());
  EXPECT_EQ(*model->reference_map(), *model->reference_map());
}

TEST(Model, PlacesAScanOfASurveyedPlaceThere) {
  const auto model = tiny_model();
  const core::Vector2 place_m(14.0, 6.0);
  const auto query = query_at({1}, place_m);
  for (const RadioPart part : kRadioParts) {
    const auto placed = (*model->positioner(part))->estimate(query, std::nullopt, std::nullopt);
    ASSERT_TRUE(placed) << static_cast<int>(part);
    EXPECT_EQ(placed->observation.floors.front().floor, core::FloorId{1}) << static_cast<int>(part);
    // The map has a point every 2 m; several neighbours or a regression blur it.
    EXPECT_LT((placed->observation.floors.front().position_m - place_m).norm(), 3.0)
        << static_cast<int>(part);
  }
  const core::Belief around{core::FloorId{1}, 1.0, core::Vector2(13.0, 6.5),
                            core::Matrix2::Identity()};
  const auto near = (*model->near_positioner())->estimate(query, core::FloorId{1}, around);
  ASSERT_TRUE(near);
  EXPECT_LT((near->observation.floors.front().position_m - place_m).norm(), 2.0);
}

TEST(Model, SharesWhatItMadeBetweenThreads) {
  const auto model = tiny_model(Field::kSurveyed);
  constexpr std::size_t kThreads = 4;
  std::array<std::vector<const void*>, kThreads> seen;
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < kThreads; ++i) {
    threads.emplace_back([&model, &mine = seen[i]] {
      for (const RadioPart part : kRadioParts) mine.push_back(model->positioner(part)->get());
      mine.push_back(model->near_positioner()->get());
      mine.push_back(*model->reference_map());
      mine.push_back(model->fields()->get());
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& mine : seen) EXPECT_EQ(mine, seen[0]);
}

TEST(Model, PreparesEveryMethod) {
  const auto model = tiny_model(Field::kSurveyed);
  for (const Method& method : methods()) EXPECT_TRUE(model->prepare(method)) << method.name;
}

TEST(Model, NeedsAMagneticMapForMagneticMatchingAlone) {
  const auto model = tiny_model();
  for (const Method& method : methods()) {
    const auto prepared = model->prepare(method);
    EXPECT_EQ(prepared.has_value(), method.name != "zhou2016") << method.name;
  }
  const auto refused = model->prepare(*find_method("zhou2016"));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, core::ErrorCode::kMapMissing);
  EXPECT_EQ(refused.error().place, "tiny");
}

TEST(Model, KnowsTheSurveyedFieldOfEachFloor) {
  const auto model = tiny_model(Field::kSurveyed);
  const auto fields = model->fields();
  ASSERT_TRUE(fields);
  ASSERT_EQ((*fields)->size(), 2U);
  const core::Vector2 place_m(14.25, 6.25);
  for (std::uint16_t floor = 0; floor < 2; ++floor) {
    const auto known = (**fields)[floor].at(place_m);
    ASSERT_TRUE(known);
    const magnetic::LevelField truth = testing::field_at({floor}, place_m);
    // Kernel and raster smooth bumps of 6 uT by some share of them.
    EXPECT_NEAR(known->horizontal_ut, truth.horizontal_ut, 3.0);
    EXPECT_NEAR(known->vertical_ut, truth.vertical_ut, 3.0);
  }
}

}  // namespace
}  // namespace waylode::pipeline
