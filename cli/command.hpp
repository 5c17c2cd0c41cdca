// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "waylode/core/result.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

/// The program `waylode`: one file per verb. A verb declares its arguments and its body:
///
///   struct Arguments { std::string log; bool json = false; };
///   void add_inspect(Verb& root) {
///     const auto arguments = std::make_shared<Arguments>();
///     Verb verb = root.verb("inspect", "Tell what a log holds");
///     verb.argument("LOG", arguments->log, "The log to read").required();
///     verb.argument("--json", arguments->json, "Print JSON");
///     verb.run([arguments] { return inspect(*arguments); });
///   }
namespace waylode::cli {

/// What a verb does once its arguments are known. Results go to standard output through `print`,
/// everything else to standard error.
using Action = std::function<core::Result<void>()>;

/// What main keeps; outlives the verbs.
struct Context {
  std::string command_line;   ///< As typed, for reports that say how to repeat them.
  core::Result<void> result;  ///< Of the verb that ran.
};

/// An argument, to be qualified where it is declared.
class Argument {
 public:
  explicit Argument(CLI::Option& option) : option_(&option) {}
  Argument& required();
  Argument& one_of(std::vector<std::string> choices);
  /// Several values in one word: "a,b,c". For lists.
  Argument& comma_separated();
  /// In [smallest, largest].
  Argument& in_range(double smallest, double largest);

 private:
  CLI::Option* option_;
};

/// A verb of the command line. Targets of arguments must live until the action has run: let the
/// action own them. "--name" and "-n,--name" are options, "NAME" is positional. A target's value
/// when declared is the default that --help shows.
class Verb {
 public:
  Verb(CLI::App& app, Context& context) : app_(&app), context_(&context) {}

  /// A verb below this one, which then cannot run by itself.
  Verb verb(const std::string& name, const std::string& summary);
  /// What --help ends with: an example or two, one a line.
  void examples(const std::string& text);

  Argument argument(const std::string& name, bool& target, const std::string& help);
  Argument argument(const std::string& name, std::string& target, const std::string& help);
  Argument argument(const std::string& name, std::optional<std::string>& target,
                    const std::string& help);
  Argument argument(const std::string& name, std::vector<std::string>& target,
                    const std::string& help);
  Argument argument(const std::string& name, double& target, const std::string& help);
  Argument argument(const std::string& name, std::optional<std::uint64_t>& target,
                    const std::string& help);

  void run(Action action);
  const Context& context() const { return *context_; }

 private:
  CLI::App* app_;
  Context* context_;
};

/// Text for standard output; main reports a failure to write.
void print(std::string_view text);
/// One line on standard error: `waylode: <text>`.
void print_note(std::string_view text);
/// One line on standard error, `waylode: <place>: <message> [name]`; returns the exit status.
int print_error(const core::Error& error);

// In the order of the work.
void add_simulate(Verb& root);
void add_inspect(Verb& root);
void add_convert(Verb& root);
void add_site(Verb& root);
void add_site_from_walks(Verb& site);  ///< Below add_site's verb.
void add_track(Verb& root);
void add_evaluate(Verb& root);
void add_reproduce(Verb& root);
void add_methods(Verb& root);
void add_config(Verb& root);
void add_version(Verb& root);

}  // namespace waylode::cli
