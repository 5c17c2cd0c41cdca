// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "waylode/log/detail/sample_codec.hpp"
#include "waylode/log/mcap_decoder.hpp"

namespace {

struct Decoded {
  std::vector<waylode::sample::Sample> samples;
  waylode::log::LogReport report;
  bool operator==(const Decoded&) const = default;
};

Decoded decode(std::string_view bytes, std::size_t piece_bytes, bool check_crc) {
  Decoded decoded;
  const auto decoder = waylode::log::make_mcap_decoder(
      [&decoded](waylode::sample::Sample&& sample) {
        decoded.samples.push_back(std::move(sample));
      },
      {check_crc});
  while (!bytes.empty()) {
    decoder->feed(bytes.substr(0, piece_bytes));
    bytes.remove_prefix(std::min(piece_bytes, bytes.size()));
  }
  decoder->finish();
  decoded.report = decoder->report();
  return decoded;
}

void require(bool condition) {
  if (!condition) __builtin_trap();
}

}  // namespace

/// Once without checksums, which would keep the fuzzer at the door, and once with them: no sample
/// has a fault, pieces give what the whole gives, and the checks only take away.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const Decoded whole = decode(bytes, SIZE_MAX, false);
  std::uint64_t accepted = 0;
  for (const auto& [kind, count] : whole.report.accepted) accepted += count;
  require(accepted == whole.samples.size());
  for (const auto& sample : whole.samples) {
    require(waylode::log::detail::fault_of(sample) == nullptr);
  }
  constexpr std::size_t kPiece_bytes = 13;
  require(decode(bytes, kPiece_bytes, false) == whole);
  require(decode(bytes, SIZE_MAX, true).samples.size() <= whole.samples.size());
  return 0;
}
