// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "command.hpp"

namespace waylode::cli {

void add_version(Verb& root) {
  Verb verb = root.verb("version", "Print the program's version");
  verb.run([]() -> core::Result<void> {
    print("waylode " WAYLODE_VERSION "\n");
    return {};
  });
}

}  // namespace waylode::cli
