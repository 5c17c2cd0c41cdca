// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/core/crc32.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>
#include <string_view>

namespace waylode::core {
namespace {

std::uint32_t crc_of(std::string_view text, std::uint32_t crc = 0) {
  return crc32(std::as_bytes(std::span(text)), crc);
}

/// The definition, a bit at a time.
std::uint32_t slow_crc_of(std::string_view text) {
  std::uint32_t state = 0xFFFF'FFFFU;
  for (const char character : text) {
    state ^= static_cast<unsigned char>(character);
    for (int bit = 0; bit < 8; ++bit)
      state = (state >> 1U) ^ ((state & 1U) != 0U ? 0xEDB8'8320U : 0U);
  }
  return ~state;
}

TEST(Crc32, HasThePublishedCheckValues) {
  EXPECT_EQ(crc_of("123456789"), 0xCBF4'3926U);
  EXPECT_EQ(crc_of("The quick brown fox jumps over the lazy dog"), 0x414F'A339U);
  EXPECT_EQ(crc_of(""), 0U);
}

RC_GTEST_PROP(Crc32, EqualsItsDefinitionAtEveryLength, (const std::string& text)) {
  RC_ASSERT(crc_of(text) == slow_crc_of(text));
}

RC_GTEST_PROP(Crc32, GoesOnWhereAnEarlierBlockEnded,
              (const std::string& first, const std::string& second)) {
  RC_ASSERT(crc_of(second, crc_of(first)) == crc_of(first + second));
}

TEST(Crc32, NoticesASingleFlippedBit) {
  std::string text = "a site bundle's section of bytes";
  const std::uint32_t before = crc_of(text);
  text[17] = static_cast<char>(text[17] ^ 0x10);
  EXPECT_NE(crc_of(text), before);
}

}  // namespace
}  // namespace waylode::core
