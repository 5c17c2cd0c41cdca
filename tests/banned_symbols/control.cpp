// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
// Everything the engine must not do, for the check to find.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <iostream>

namespace waylode::control {

int use_everything(int choice) {
  if (choice == 1) std::abort();
  if (choice == 2) std::exit(choice);
  std::puts("control");
  std::cerr << std::chrono::steady_clock::now().time_since_epoch().count()
            << std::chrono::system_clock::now().time_since_epoch().count();
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  return std::rand() + (std::getenv("HOME") != nullptr ? 1 : 0);
}

}  // namespace waylode::control
