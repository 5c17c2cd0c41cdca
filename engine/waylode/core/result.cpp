// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/core/result.hpp"

namespace waylode::core {

const ErrorInfo& error_info(ErrorCode code) {
  for (const ErrorInfo& info : kErrorTable) {
    if (info.code == code) return info;
  }
  return kErrorTable[0];
}

std::string to_string(const Error& error) {
  std::string text;
  if (!error.place.empty()) text += error.place + ": ";
  text += error.message;
  text += " [";
  text += error_info(error.code).name;
  text += "]";
  return text;
}

}  // namespace waylode::core
