// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "waylode/pipeline/method.hpp"

namespace waylode::cli {
namespace {

/// "steps=adaptive_peaks stride=improved ...", every slot once.
std::string recipe_text(const pipeline::Recipe& recipe) {
  std::string text;
  std::string_view last;
  for (const pipeline::Part& part : pipeline::parts()) {
    if (part.slot == last) continue;
    last = part.slot;
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", last, part_name(recipe, last));
  }
  return text;
}

std::string methods_text() {
  std::string text = fmt::format("{:<15} {:<54} {:<20} {}\n", "METHOD", "WHAT", "SOURCE", "NEEDS");
  for (const pipeline::Method& method : pipeline::methods()) {
    text += fmt::format("{:<15} {:<54} {:<20} {}\n", method.name, method.summary, method.source,
                        method.needs);
  }
  text += "\nEvery method is a choice of parts:\n";
  for (const pipeline::Method& method : pipeline::methods()) {
    text += fmt::format("{:<15} {}\n", method.name, recipe_text(method.recipe));
  }
  text += fmt::format("\n{:<9} {:<21} {:<66} {}\n", "SLOT", "PART", "WHAT", "SOURCE");
  for (const pipeline::Part& part : pipeline::parts()) {
    text +=
        fmt::format("{:<9} {:<21} {:<66} {}\n", part.slot, part.name, part.summary, part.source);
  }
  return text +
         "\nMix them: METHOD+SLOT=PART+..., such as wu2019+stride=kim+fusion=pairs. Sources are "
         "keys of\ndocs/references.bib; docs/methods says which equation is which function.\n";
}

nlohmann::ordered_json recipe_json(const pipeline::Recipe& recipe) {
  nlohmann::ordered_json json;
  for (const pipeline::Part& part : pipeline::parts()) {
    json[std::string(part.slot)] = part_name(recipe, part.slot);
  }
  return json;
}

std::string methods_json() {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const pipeline::Method& method : pipeline::methods()) {
    list.push_back({{"name", method.name},
                    {"summary", method.summary},
                    {"source", method.source},
                    {"needs", method.needs},
                    {"lag_s", core::to_seconds(method.lag)},
                    {"whole_track", method.whole_track()},
                    {"parts", recipe_json(method.recipe)}});
  }
  nlohmann::ordered_json parts = nlohmann::ordered_json::array();
  for (const pipeline::Part& part : pipeline::parts()) {
    parts.push_back({{"slot", part.slot},
                     {"name", part.name},
                     {"summary", part.summary},
                     {"source", part.source}});
  }
  return nlohmann::ordered_json{{"methods", list}, {"parts", parts}}.dump(2) + "\n";
}

}  // namespace

void add_methods(Verb& root) {
  const auto as_json = std::make_shared<bool>(false);
  Verb verb = root.verb("methods", "List the positioning methods and the parts they are made of");
  verb.examples("  waylode methods --json");
  verb.argument("--json", *as_json, "Print JSON");
  verb.run([as_json]() -> core::Result<void> {
    print(*as_json ? methods_json() : methods_text());
    return {};
  });
}

}  // namespace waylode::cli
