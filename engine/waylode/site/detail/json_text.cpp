// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/detail/json_text.hpp"

#include <string>

namespace waylode::site::detail {

core::Result<nlohmann::json> parse_json(std::string_view text, std::string_view place,
                                        core::ErrorCode code) {
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    return core::fail(code, "not valid JSON; restore the file or export it again",
                      std::string(place) + " at byte " + std::to_string(error.byte));
  } catch (const nlohmann::json::exception&) {
    return core::fail(code, "a JSON number is out of range; correct it", std::string(place));
  }
}

const nlohmann::json* find_member(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);  // end() for anything but an object
  return found == object.end() ? nullptr : &*found;
}

}  // namespace waylode::site::detail
