// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "waylode/log/log_reader.hpp"

namespace waylode::log {

struct McapDecoderOptions {
  /// Compare the checksums of the file. Off only to look into a file that is known to be damaged.
  bool check_crc = true;
};

/// Reads Waylode's own log, contract/log-format.md: MCAP, chunked or not, plain or zstd. Topics of
/// other programs are counted as ignored. Buffers one record at a time and refuses those above
/// 64 MiB, packed or unpacked.
std::unique_ptr<Decoder> make_mcap_decoder(SampleSink sink, McapDecoderOptions options = {});

}  // namespace waylode::log
