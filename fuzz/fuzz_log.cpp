// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
// Any bytes as a log file: decompression, recognition and the reader that is chosen.
#include <cstdint>

#include "decoder_check.hpp"
#include "waylode/log/log_reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace waylode;
  std::uint64_t delivered = 0;
  const auto report =
      log::read_log_bytes(fuzz::text_of(data, size), "fuzz", [&delivered](sample::Sample&& sample) {
        fuzz::check_sample(sample);
        ++delivered;
      });
  if (!report) {
    fuzz::require(!report.error().message.empty() && report.error().place == "fuzz");
    return 0;
  }
  std::uint64_t accepted = 0;
  for (const auto& [kind, count] : report->accepted) accepted += count;
  fuzz::require(accepted == delivered);
  return 0;
}
