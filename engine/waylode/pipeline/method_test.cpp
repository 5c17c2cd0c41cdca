// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pipeline/method.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace waylode::pipeline {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Methods, AreThoseThatTheEvaluationNames) {
  std::vector<std::string_view> names;
  for (const Method& method : methods()) names.push_back(method.name);
  EXPECT_THAT(names,
              ElementsAre("wknn", "pdr", "wu2019", "zhou2016", "zhao2019", "zhong2017", "fused",
                          "smoothed_lag5", "smoothed_lag10", "smoothed_lag30", "smoothed"));
}

TEST(Methods, SayWhatTheyAreAndNeed) {
  for (const Method& method : methods()) {
    EXPECT_FALSE(method.summary.empty()) << method.name;
    EXPECT_FALSE(method.source.empty()) << method.name;
    EXPECT_FALSE(method.needs.empty()) << method.name;
  }
}

TEST(FindMethod, FindsEveryMethodByItsName) {
  for (const Method& method : methods()) {
    const auto found = find_method(method.name);
    ASSERT_TRUE(found) << method.name;
    EXPECT_EQ(found->name, method.name);
    EXPECT_EQ(found->recipe, method.recipe);
  }
}

TEST(FindMethod, GivesLagsAsNamed) {
  EXPECT_EQ(find_method("smoothed_lag5")->lag, std::chrono::seconds(5));
  EXPECT_EQ(find_method("smoothed_lag10")->lag, std::chrono::seconds(10));
  EXPECT_EQ(find_method("smoothed_lag30")->lag, std::chrono::seconds(30));
  for (const char* causal : {"wknn", "pdr", "fused"}) {
    EXPECT_EQ(find_method(causal)->lag, core::Duration{}) << causal;
    EXPECT_FALSE(find_method(causal)->whole_track()) << causal;
  }
  EXPECT_TRUE(find_method("smoothed")->whole_track());
}

TEST(FindMethod, NamesAllKnownMethodsWhenAskedForAnother) {
  for (const char* name : {"", "kalman", "Fused", "fused "}) {
    const auto found = find_method(name);
    ASSERT_FALSE(found) << name;
    EXPECT_EQ(found.error().code, core::ErrorCode::kMethodUnknown);
    EXPECT_EQ(found.error().place, name);
    for (const Method& method : methods()) {
      EXPECT_THAT(found.error().message, HasSubstr(std::string(method.name)));
    }
  }
}

TEST(FindMethod, MixesPartsIntoANamedMethod) {
  const auto mixed = find_method("wu2019+stride=kim+fusion=pairs");
  ASSERT_TRUE(mixed) << mixed.error().message;
  EXPECT_EQ(mixed->name, "wu2019+stride=kim+fusion=pairs");
  Recipe expected = find_method("wu2019")->recipe;
  expected.stride = pdr::StrideModel::Model::kKim;
  expected.fusion = FusionPart::kPairs;
  EXPECT_EQ(mixed->recipe, expected);
}

TEST(FindMethod, RefusesMixturesThatMakeNoSense) {
  for (const char* name : {"fused+fusion=fixed_lag", "smoothed_lag5+fusion=robust",
                           "fused+radio=none", "fused+magnetic=sequence"}) {
    const auto found = find_method(name);
    ASSERT_FALSE(found) << name;
    EXPECT_EQ(found.error().code, core::ErrorCode::kInvalidArgument) << name;
    EXPECT_EQ(found.error().place, name);
  }
  for (const char* name : {"fused+", "fused+stride", "fused+stride=kim+", "kalman+stride=kim"}) {
    const auto found = find_method(name);
    ASSERT_FALSE(found) << name;
    EXPECT_EQ(found.error().code, core::ErrorCode::kMethodUnknown) << name;
  }
}

TEST(Methods, OfThePapersAreTheRecipesOfTheSpecification) {
  const Recipe wu = find_method("wu2019")->recipe;
  EXPECT_EQ(part_name(wu, "steps"), "adaptive_peaks");
  EXPECT_EQ(part_name(wu, "stride"), "improved_learnt");
  EXPECT_EQ(part_name(wu, "radio"), "region_wknn");
  EXPECT_EQ(part_name(wu, "fusion"), "unscented");
  const Recipe zhou = find_method("zhou2016")->recipe;
  EXPECT_EQ(part_name(zhou, "stride"), "weinberg");
  EXPECT_EQ(part_name(zhou, "radio"), "window_knn");
  EXPECT_EQ(part_name(zhou, "magnetic"), "sequence");
  const Recipe zhao = find_method("zhao2019")->recipe;
  EXPECT_EQ(part_name(zhao, "steps"), "gaussian_peaks");
  EXPECT_EQ(part_name(zhao, "radio"), "relevance_vectors");
  EXPECT_EQ(part_name(zhao, "fusion"), "feedback");
  const Recipe zhong = find_method("zhong2017")->recipe;
  EXPECT_EQ(part_name(zhong, "steps"), "extrema");
  EXPECT_EQ(part_name(zhong, "validity"), "excursion");
  EXPECT_EQ(part_name(zhong, "stride"), "chen");
  EXPECT_TRUE(find_method("zhong2017")->needs_start());
}

}  // namespace
}  // namespace waylode::pipeline
