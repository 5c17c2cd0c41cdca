// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pipeline/recipe.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace waylode::pipeline {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Parts, FillSevenSlotsInTheOrderOfTheData) {
  std::vector<std::string_view> slots;
  for (const Part& part : parts()) {
    if (slots.empty() || slots.back() != part.slot) slots.push_back(part.slot);
  }
  EXPECT_THAT(slots,
              ElementsAre("steps", "validity", "stride", "heading", "radio", "magnetic", "fusion"));
}

TEST(Parts, HaveNamesOfTheirOwnAndSayWhatTheyAre) {
  std::set<std::pair<std::string_view, std::string_view>> names;
  for (const Part& part : parts()) {
    EXPECT_TRUE(names.emplace(part.slot, part.name).second) << part.slot << "=" << part.name;
    EXPECT_FALSE(part.summary.empty()) << part.name;
    EXPECT_FALSE(part.source.empty()) << part.name;
    EXPECT_EQ(part.name.find_first_of("+=, "), std::string_view::npos) << part.name;
  }
}

TEST(ChoosePart, FillsItsSlotAndNoOther) {
  for (const Part& part : parts()) {
    Recipe recipe;
    const std::string assignment = std::string(part.slot) + "=" + std::string(part.name);
    ASSERT_TRUE(choose_part(recipe, assignment)) << assignment;
    EXPECT_EQ(part_name(recipe, part.slot), part.name);
    for (const Part& other : parts()) {
      if (other.slot == part.slot) continue;
      EXPECT_EQ(part_name(recipe, other.slot), part_name(Recipe(), other.slot))
          << assignment << " changed " << other.slot;
    }
  }
}

TEST(ChoosePart, NamesWhatIsKnown) {
  Recipe recipe;
  const auto no_part = choose_part(recipe, "stride=giant");
  ASSERT_FALSE(no_part);
  EXPECT_EQ(no_part.error().code, core::ErrorCode::kMethodUnknown);
  EXPECT_THAT(no_part.error().message, HasSubstr("weinberg, scarlett, kim"));
  for (const char* text : {"", "=", "shoes=red", "stride", "stride="}) {
    const auto refused = choose_part(recipe, text);
    ASSERT_FALSE(refused) << text;
    EXPECT_EQ(refused.error().code, core::ErrorCode::kMethodUnknown) << text;
  }
  EXPECT_EQ(recipe, Recipe());
}

}  // namespace
}  // namespace waylode::pipeline
