// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
// What a user's program would do first: include, call, link.
#include <waylode/core/angle.hpp>
#include <waylode/core/result.hpp>
#include <waylode/sample/sample.hpp>

int main() {
  const double wrapped_rad = waylode::core::wrap_angle(3.0 * waylode::core::kPi);
  const bool wraps = wrapped_rad > 3.14159 && wrapped_rad < 3.1416;
  const bool maps =
      waylode::core::error_info(waylode::core::ErrorCode::kFileNotFound).exit_status == 3;
  const waylode::sample::Sample sample = waylode::sample::BarometerSample{};
  return wraps && maps && waylode::sample::kind_of(sample) == std::string_view("barometer") ? 0 : 1;
}
