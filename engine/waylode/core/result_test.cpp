// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/core/result.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace waylode::core {
namespace {

Result<int> half_of(int number) {
  if (number % 2 != 0)
    return fail(ErrorCode::kInvalidArgument, "odd; give an even number", "input:3");
  return number / 2;
}

TEST(Result, HoldsAValueOrTheReasonForNone) {
  EXPECT_EQ(half_of(14), 7);
  const Error expected{ErrorCode::kInvalidArgument, "odd; give an even number", "input:3"};
  EXPECT_EQ(half_of(13).error(), expected);
}

TEST(Error, IsOneLineWithPlaceMessageAndName) {
  EXPECT_EQ(to_string(half_of(13).error()), "input:3: odd; give an even number [invalid_argument]");
  EXPECT_EQ(to_string(Error{ErrorCode::kLogEmpty, "no records", ""}), "no records [log_empty]");
}

TEST(ErrorRegistry, KnowsEachCode) {
  for (const ErrorInfo& info : kErrorTable) EXPECT_EQ(error_info(info.code).name, info.name);
  EXPECT_EQ(error_info(ErrorCode::kFileNotFound).exit_status, 3);
  EXPECT_EQ(error_info(ErrorCode::kFileUnwritable).exit_status, 6);
  EXPECT_EQ(error_info(ErrorCode::kFileNotFound).http_status, 404);
}

TEST(ErrorRegistry, TakesAnUnknownCodeForADefectOfOurs) {
  EXPECT_EQ(error_info(static_cast<ErrorCode>(64'999)).code, ErrorCode::kInternal);
}

TEST(ErrorRegistry, HasDistinctNamesAndAgreedExits) {
  const std::set<int> agreed = {2, 3, 4, 5, 6, 70};
  std::set<std::string_view> names;
  for (const ErrorInfo& info : kErrorTable) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_TRUE(agreed.contains(info.exit_status)) << info.name;
    EXPECT_GE(info.http_status, 400) << info.name;
    EXPECT_EQ(info.message.find('\n'), std::string_view::npos) << info.name;
  }
}

}  // namespace
}  // namespace waylode::core
