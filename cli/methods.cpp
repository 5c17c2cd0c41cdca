// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "waylode/pipeline/method.hpp"

namespace waylode::cli {
namespace {

std::string methods_text() {
  std::string text = fmt::format("{:<15} {:<54} {:<20} {}\n", "METHOD", "WHAT", "SOURCE", "NEEDS");
  for (const pipeline::Method& method : pipeline::methods()) {
    text += fmt::format("{:<15} {:<54} {:<20} {}\n", method.name, method.summary, method.source,
                        method.needs);
  }
  return text;
}

std::string methods_json() {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const pipeline::Method& method : pipeline::methods()) {
    list.push_back({{"name", method.name},
                    {"summary", method.summary},
                    {"source", method.source},
                    {"needs", method.needs},
                    {"lag_s", core::to_seconds(method.lag)},
                    {"whole_track", method.whole_track()}});
  }
  return nlohmann::ordered_json{{"methods", list}}.dump(2) + "\n";
}

}  // namespace

void add_methods(Verb& root) {
  const auto as_json = std::make_shared<bool>(false);
  Verb verb = root.verb("methods", "List the positioning methods");
  verb.examples("  waylode methods --json");
  verb.argument("--json", *as_json, "Print JSON");
  verb.run([as_json]() -> core::Result<void> {
    print(*as_json ? methods_json() : methods_text());
    return {};
  });
}

}  // namespace waylode::cli
