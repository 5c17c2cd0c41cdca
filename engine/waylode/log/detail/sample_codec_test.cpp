// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/log/detail/sample_codec.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "waylode/log/test_samples.hpp"

namespace waylode::log::detail {
namespace {

using core::DeviceTime;
using core::Duration;
using core::TransmitterId;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::string encode(const sample::Sample& sample) {
  std::string bytes;
  encode_sample(sample, bytes);
  return bytes;
}

std::string fault_name(const sample::Sample& sample) {
  const char* fault = fault_of(sample);
  return fault == nullptr ? "" : fault;
}

TEST(SampleCodec, DecodesWhatItEncodes) {
  core::Rng rng(20240131);
  for (std::size_t kind = 0; kind < kSampleKindCount; ++kind) {
    for (int round = 0; round < 300; ++round) {
      const sample::Sample sample = test::random_sample(rng, kind);
      ASSERT_EQ(fault_name(sample), "") << sample::kind_of(sample);
      const auto decoded = decode_sample(kind, encode(sample));
      ASSERT_TRUE(decoded) << sample::kind_of(sample) << ": " << decoded.error();
      ASSERT_EQ(*decoded, sample) << sample::kind_of(sample);
    }
  }
}

// The octets by hand from the Protobuf encoding: tag = field << 3 | type, type 1 = 8 octets.
TEST(SampleCodec, WritesTheWireFormOfTheSchema) {
  const sample::BarometerSample sample{DeviceTime(Duration(-2)), 1.0};
  const std::string expected("\x09\xFE\xFF\xFF\xFF\xFF\xFF\xFF\xFF\x11\0\0\0\0\0\0\xF0\x3F", 18);
  EXPECT_EQ(encode(sample), expected);
}

TEST(SampleCodec, AppendsToWhatIsThere) {
  std::string bytes = "before";
  encode_sample(sample::BarometerSample{{}, 1.0}, bytes);
  EXPECT_EQ(bytes.substr(0, 6), "before");
  EXPECT_EQ(bytes.substr(6), encode(sample::BarometerSample{{}, 1.0}));
}

TEST(SampleCodec, SkipsFieldsOfLaterVersions) {
  const sample::Sample sample = sample::BarometerSample{{}, 950.5};
  // Field 100, length-delimited, three octets.
  const auto decoded = decode_sample(sample.index(), encode(sample) + "\xA2\x06\x03new");
  ASSERT_TRUE(decoded);
  EXPECT_EQ(*decoded, sample);
}

TEST(SampleCodec, RejectsWhatIsNoMessage) {
  const std::string bytes = encode(test::one_of_each().front());
  for (std::size_t kind = 0; kind < kSampleKindCount; ++kind) {
    const auto decoded = decode_sample(kind, bytes.substr(0, bytes.size() - 1));
    ASSERT_FALSE(decoded);
    EXPECT_STREQ(decoded.error(), "bad_message");
  }
}

TEST(SampleCodec, RejectsTextThatIsNotUtf8WithoutAWord) {
  const sample::Sample sample = sample::WaypointSample{{}, core::Vector2(1.0, 2.0), {}, "AB"};
  std::string bytes = encode(sample);
  bytes.back() = '\xFF';
  testing::internal::CaptureStderr();
  const auto decoded = decode_sample(sample.index(), bytes);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  ASSERT_FALSE(decoded);
  EXPECT_STREQ(decoded.error(), "bad_message");
}

TEST(SampleCodec, RejectsAFaultOnDecoding) {
  std::string bytes = encode(sample::BarometerSample{{}, 1000.0});
  bytes.replace(bytes.size() - 2, 2, "\xF8\x7F");  // The exponent of a NaN.
  const auto decoded = decode_sample(7, bytes);
  ASSERT_FALSE(decoded);
  EXPECT_STREQ(decoded.error(), "not_finite");
}

TEST(SampleFault, KnowsNumbersThatAreNone) {
  EXPECT_EQ(fault_name(sample::AccelerometerSample{{}, {0.0, kNan, 0.0}}), "not_finite");
  EXPECT_EQ(fault_name(sample::GyroscopeSample{{}, {kInfinity, 0.0, 0.0}}), "not_finite");
  EXPECT_EQ(fault_name(sample::UncalibratedMagnetometerSample{{}, {1, 2, 3}, {0.0, 0.0, kNan}}),
            "not_finite");
  EXPECT_EQ(fault_name(sample::BleReading{{}, {}, -60.0F, kInfinity, ""}), "not_finite");
  EXPECT_EQ(fault_name(sample::WifiScan{{}, {{{}, -kInfinity, 0, {}, ""}}}), "not_finite");
}

TEST(SampleFault, KnowsValuesOutOfRange) {
  EXPECT_EQ(fault_name(sample::MagnetometerSample{{}, {1, 2, 3}, 4}), "out_of_range");
  EXPECT_EQ(fault_name(sample::RotationSample{{}, {0.0, 0.0, 0.0, 0.0}}), "out_of_range");
  EXPECT_EQ(fault_name(sample::BarometerSample{{}, 0.0}), "out_of_range");
  EXPECT_EQ(fault_name(sample::GnssSample{{}, {90.5, 0.0}, 1.0}), "out_of_range");
  EXPECT_EQ(fault_name(sample::GnssSample{{}, {0.0, 180.5}, 1.0}), "out_of_range");
  EXPECT_EQ(fault_name(sample::GnssSample{{}, {0.0, 0.0}, -1.0}), "out_of_range");
  EXPECT_EQ(fault_name(sample::AccelerometerSample{{}, {0.0, 0.0, -401.0}}), "out_of_range");
  EXPECT_EQ(fault_name(sample::WifiScan{{}, {{{}, 21.0F, 2412, {}, ""}}}), "out_of_range");
  EXPECT_EQ(fault_name(sample::WifiScan{{}, {{{}, -50.0F, -1, {}, ""}}}), "out_of_range");
  EXPECT_EQ(fault_name(sample::WaypointSample{{}, std::nullopt, std::nullopt, ""}), "out_of_range");
  EXPECT_EQ(fault_name(sample::WaypointSample{{}, core::Vector2(0, 0), core::GeoPoint{}, ""}),
            "out_of_range");
}

TEST(SampleFault, KnowsReadingsHeardAfterTheirDelivery) {
  const DeviceTime later{Duration(1)};
  EXPECT_EQ(fault_name(sample::WifiScan{{}, {{{}, -50.0F, 0, later, ""}}}),
            "last_seen_after_delivery");
  EXPECT_EQ(fault_name(sample::WifiScan{later, {{{}, -50.0F, 0, later, ""}}}), "");
}

TEST(SampleFault, KnowsTransmittersOfNoKind) {
  EXPECT_EQ(fault_name(sample::BleReading{{}, TransmitterId::from_packed(3ULL << 56U), 0, {}, ""}),
            "bad_transmitter");
  EXPECT_EQ(fault_name(sample::BleReading{{}, TransmitterId::from_packed(1ULL << 48U), 0, {}, ""}),
            "bad_transmitter");
}

TEST(SampleFault, KnowsTextThatIsNotUtf8) {
  // Too long a form, a surrogate, beyond the last character, cut short, a lone continuation.
  for (const char* bad : {"\xC0\xAF", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xE6\xA5", "\x80"}) {
    EXPECT_EQ(fault_name(sample::WaypointSample{{}, core::Vector2(0, 0), {}, bad}), "bad_text");
  }
}

}  // namespace
}  // namespace waylode::log::detail
