// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "waylode/learn/model_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto regression = waylode::learn::parse_model(text, "fuzz");
  if (!regression) return 0;
  // What was accepted is written, read back and written the same, and predicts or says why not.
  const std::string written = waylode::learn::format_model(*regression);
  const auto again = waylode::learn::parse_model(written, "fuzz");
  if (!again || waylode::learn::format_model(*again) != written) __builtin_trap();
  const Eigen::MatrixXd inputs = Eigen::MatrixXd::Constant(1, regression->dimensions(), -61.5);
  const auto estimate = regression->predict(inputs);
  if (estimate && !estimate->mean.allFinite()) __builtin_trap();
  return 0;
}
