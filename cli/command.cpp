// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "command.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdio>
#include <utility>

namespace waylode::cli {

Argument& Argument::required() {
  option_->required();
  return *this;
}

Argument& Argument::one_of(std::vector<std::string> choices) {
  option_->check(CLI::IsMember(std::move(choices)));
  return *this;
}

Argument& Argument::comma_separated() {
  option_->delimiter(',');
  return *this;
}

Argument& Argument::in_range(double smallest, double largest) {
  option_->check(CLI::Range(smallest, largest));
  return *this;
}

Verb Verb::verb(const std::string& name, const std::string& summary) {
  app_->require_subcommand(1);
  return Verb(*app_->add_subcommand(name, summary), *context_);
}

void Verb::examples(const std::string& text) { app_->footer("Example:\n" + text); }

Argument Verb::argument(const std::string& name, bool& target, const std::string& help) {
  return Argument(*app_->add_flag(name, target, help));
}

Argument Verb::argument(const std::string& name, std::string& target, const std::string& help) {
  CLI::Option* option = app_->add_option(name, target, help);
  if (!target.empty()) option->capture_default_str();
  return Argument(*option);
}

Argument Verb::argument(const std::string& name, std::optional<std::string>& target,
                        const std::string& help) {
  return Argument(*app_->add_option_function<std::string>(
      name, [&target](const std::string& text) { target = text; }, help));
}

Argument Verb::argument(const std::string& name, std::vector<std::string>& target,
                        const std::string& help) {
  CLI::Option* option = app_->add_option(name, target, help);
  // An option takes one word each time, so that it never swallows the positional ones after it.
  if (name.starts_with('-')) option->allow_extra_args(false);
  if (!target.empty()) option->capture_default_str();
  return Argument(*option);
}

Argument Verb::argument(const std::string& name, double& target, const std::string& help) {
  return Argument(*app_->add_option(name, target, help)->capture_default_str());
}

Argument Verb::argument(const std::string& name, std::optional<std::uint64_t>& target,
                        const std::string& help) {
  return Argument(*app_->add_option_function<std::uint64_t>(
      name, [&target](const std::uint64_t& number) { target = number; }, help));
}

void Verb::run(Action action) {
  app_->callback([context = context_, action = std::move(action)] { context->result = action(); });
}

void print(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stdout); }

void print_note(std::string_view text) {
  const std::string line = "waylode: " + std::string(text) + "\n";
  std::fputs(line.c_str(), stderr);
}

int print_error(const core::Error& error) {
  std::string line = core::to_string(error);
  for (char& character : line) {
    if (character == '\n' || character == '\r') character = ' ';
  }
  print_note(line);
  return core::error_info(error.code).exit_status;
}

}  // namespace waylode::cli
