// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

#include "waylode/core/error_code.hpp"

namespace waylode::core {

/// An expected failure: what, where and what to do about it.
struct Error {
  ErrorCode code = ErrorCode::kInternal;
  /// One sentence with the remedy, no trailing newline: "no Wi-Fi record; record with Wi-Fi on".
  std::string message;
  /// Where: a file, optionally with ":line" or " at byte N". Empty if there is no place.
  std::string place;

  bool operator==(const Error&) const = default;
};

/// Value or Error. The engine neither prints nor throws for bad input.
template <typename T>
using Result = tl::expected<T, Error>;

inline tl::unexpected<Error> fail(ErrorCode code, std::string message, std::string place = {}) {
  return tl::unexpected<Error>(Error{code, std::move(message), std::move(place)});
}

/// The registry's row for a code.
const ErrorInfo& error_info(ErrorCode code);

/// "place: message [name]", the form every front end shows.
std::string to_string(const Error& error);

}  // namespace waylode::core
