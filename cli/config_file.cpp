// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "config_file.hpp"

#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <map>

#include "waylode/core/file.hpp"
#include "waylode/pipeline/options_visitor.hpp"

namespace waylode::cli {
namespace {

using pipeline::Choice;
using pipeline::OptionRef;

constexpr const char* kHead =
    "# Every option of Waylode's engine with its default. Keep in a file of your own the lines "
    "you\n"
    "# change and pass it with --config. What is not an option is an error.\n";

std::string number_text(double number, bool whole) {
  std::string text = fmt::format("{}", number);
  if (!whole && text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

/// Floats are written as floats, so that 0.85F does not become 0.8500000238.
std::string value_text(const OptionRef& option) {
  if (const auto* choice = std::get_if<Choice>(&option.target)) {
    return fmt::format("\"{}\"", choice->names[choice->get()]);
  }
  if (auto* const* number = std::get_if<float*>(&option.target)) {
    const std::string text = fmt::format("{}", **number);
    return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
  }
  if (auto* const* number = std::get_if<double*>(&option.target)) {
    return number_text(**number, false);
  }
  if (auto* const* number = std::get_if<int*>(&option.target)) return std::to_string(**number);
  return std::to_string(*std::get<std::size_t*>(option.target));
}

std::string range_text(const OptionRef& option) {
  if (const auto* choice = std::get_if<Choice>(&option.target)) {
    return fmt::format("one of {}", fmt::join(choice->names, ", "));
  }
  if (option.smallest == pipeline::kAboveZero) return fmt::format("in (0, {}]", option.largest);
  return fmt::format("in [{}, {}]", option.smallest, option.largest);
}

/// Walks a file's tables and sets what they name.
class OptionsReader {
 public:
  OptionsReader(pipeline::Options& options, const std::string& place) : place_(place) {
    pipeline::for_each_option(options, [this](const OptionRef& option) {
      options_.emplace(fmt::format("{}.{}", option.table, option.name), option);
    });
  }

  core::Result<void> read(const toml::table& table, const std::string& prefix) {
    for (const auto& [key, node] : table) {
      const std::string path = prefix + std::string(key.str());
      if (const toml::table* inner = node.as_table(); inner != nullptr && is_table(path)) {
        if (auto read_inner = read(*inner, path + "."); !read_inner) return read_inner;
        continue;
      }
      const auto line = key.source().begin.line;
      const auto found = options_.find(path);
      if (found == options_.end()) {
        return fail(line, path + " is no option; `waylode config dump` lists all");
      }
      if (!set(found->second, node)) {
        return fail(line, fmt::format("{} must be {}", path, range_text(found->second)));
      }
    }
    return {};
  }

 private:
  bool is_table(const std::string& path) const {
    const auto found = options_.lower_bound(path + ".");
    return found != options_.end() && found->first.starts_with(path + ".");
  }

  tl::unexpected<core::Error> fail(std::uint32_t line, std::string message) const {
    return core::fail(core::ErrorCode::kInvalidOptions, std::move(message),
                      fmt::format("{}:{}", place_, line));
  }

  static bool set(const OptionRef& option, const toml::node& node) {
    if (const auto* choice = std::get_if<Choice>(&option.target)) {
      const auto name = node.value_exact<std::string>();
      const auto found = std::ranges::find(choice->names, name.value_or(""));
      if (found == choice->names.end()) return false;
      choice->set(static_cast<std::size_t>(found - choice->names.begin()));
      return true;
    }
    const bool whole = std::holds_alternative<int*>(option.target) ||
                       std::holds_alternative<std::size_t*>(option.target);
    if (whole ? !node.is_integer() : !node.is_number()) return false;
    const double number = *node.value<double>();
    if (!(number >= option.smallest && number <= option.largest)) return false;
    std::visit(
        [number](const auto& target) {
          if constexpr (requires { *target = 0; }) {
            *target = static_cast<std::remove_cvref_t<decltype(*target)>>(number);
          }
        },
        option.target);
    return true;
  }

  const std::string& place_;
  std::map<std::string, OptionRef> options_;
};

}  // namespace

std::string format_options(pipeline::Options options) {
  std::string text = kHead;
  std::string_view table;
  pipeline::for_each_option(options, [&](const OptionRef& option) {
    if (option.table != table) text += fmt::format("\n[{}]\n", option.table);
    table = option.table;
    text += fmt::format("# {} Must be {}.\n{} = {}\n", option.comment, range_text(option),
                        option.name, value_text(option));
  });
  return text;
}

core::Result<pipeline::Options> parse_options(std::string_view toml, const std::string& place) {
  const toml::parse_result parsed = toml::parse(toml, place);
  if (!parsed) {
    return core::fail(core::ErrorCode::kInvalidOptions, std::string(parsed.error().description()),
                      fmt::format("{}:{}", place, parsed.error().source().begin.line));
  }
  pipeline::Options options;
  if (auto read = OptionsReader(options, place).read(parsed.table(), ""); !read) {
    return tl::unexpected(read.error());
  }
  if (auto valid = options.validate(); !valid) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      valid.error().place + ": " + valid.error().message, place);
  }
  return options;
}

core::Result<pipeline::Options> load_options(const std::optional<std::string>& path) {
  if (!path) return pipeline::Options{};
  const auto text = core::read_file(*path);
  if (!text) return tl::unexpected(text.error());
  return parse_options(*text, *path);
}

}  // namespace waylode::cli
