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
  EXPECT_THAT(names, ElementsAre("wknn", "pdr", "fused", "smoothed_lag5", "smoothed_lag10",
                                 "smoothed_lag30", "smoothed"));
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
    EXPECT_EQ(found->kind, method.kind);
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

}  // namespace
}  // namespace waylode::pipeline
