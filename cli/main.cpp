// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>

#include "command.hpp"

namespace {

using waylode::core::Error;
using waylode::core::ErrorCode;

constexpr const char* kAbout =
    "Waylode: where a person with a phone is inside a building.\n"
    "Verbs, in the order of the work:\n"
    "  simulate or record -> inspect -> site build -> track -> evaluate";
constexpr const char* kFooter =
    "Example: waylode inspect walk.mcap\n"
    "Every verb explains itself: waylode VERB --help";

void add_verbs(waylode::cli::Verb root) {
  using namespace waylode::cli;
  add_simulate(root);
  add_inspect(root);
  add_convert(root);
  add_site(root);
  add_track(root);
  add_evaluate(root);
  add_reproduce(root);
  add_methods(root);
  add_config(root);
  add_version(root);
}

std::string join(int count, char** words) {
  std::string line;
  for (int i = 0; i < count; ++i) line += (i == 0 ? "" : " ") + std::string(words[i]);
  return line;
}

/// Help that was asked for goes to standard output; anything else is a usage error.
int report_parse(const CLI::App& root, const CLI::ParseError& stop) {
  if (stop.get_exit_code() == 0) return root.exit(stop);
  return waylode::cli::print_error(
      {ErrorCode::kInvalidArgument, std::string(stop.what()) + "; see waylode --help", ""});
}

int run(int count, char** words) {
  CLI::App root(kAbout, "waylode");
  root.footer(kFooter);
  waylode::cli::Context context;
  context.command_line = join(count, words);
  add_verbs(waylode::cli::Verb(root, context));
  try {
    root.parse(count, words);
  } catch (const CLI::ParseError& stop) {
    if (const int status = report_parse(root, stop); status != 0) return status;
  }
  if (!context.result) return waylode::cli::print_error(context.result.error());
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    return waylode::cli::print_error(
        {ErrorCode::kFileUnwritable, "cannot be written; free some space", "standard output"});
  }
  return 0;
}

}  // namespace

int main(int count, char** words) {
  // A full disk or a limit on file sizes is then an error of the write, not a signal.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return run(count, words);
  } catch (const std::exception& trouble) {
    return waylode::cli::print_error({ErrorCode::kInternal, trouble.what(), ""});
  }
}
