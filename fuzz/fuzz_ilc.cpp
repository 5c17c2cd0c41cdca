// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "decoder_check.hpp"
#include "waylode/log/ilc_decoder.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  waylode::fuzz::check_decoder(waylode::fuzz::text_of(data, size), waylode::log::make_ilc_decoder);
  return 0;
}
