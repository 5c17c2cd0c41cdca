// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "command.hpp"
#include "config_file.hpp"

namespace waylode::cli {
namespace {

core::Result<void> check(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    if (const auto options = load_options(path); !options) {
      return tl::unexpected(options.error());
    }
  }
  return {};
}

}  // namespace

void add_config(Verb& root) {
  Verb config = root.verb("config", "Show or check the engine's options");
  Verb dump = config.verb("dump", "Print every option with default, range and meaning (TOML)");
  dump.examples("  waylode config dump > my.toml");
  dump.run([]() -> core::Result<void> {
    print(format_options({}));
    return {};
  });
  const auto paths = std::make_shared<std::vector<std::string>>();
  Verb checking = config.verb("check", "Say whether configuration files are valid");
  checking.examples("  waylode config check my.toml");
  checking.argument("FILE", *paths, "The files to check").required();
  checking.run([paths] { return check(*paths); });
}

}  // namespace waylode::cli
