# SPDX-FileCopyrightText: The Waylode authors
# SPDX-License-Identifier: Apache-2.0
# One interface target that carries warnings, sanitizers and assertion switches to every target
# of ours, tests and tools included.
add_library(waylode_warnings INTERFACE)
target_compile_options(waylode_warnings INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
if(WAYLODE_WERROR)
  target_compile_options(waylode_warnings INTERFACE -Werror)
endif()
if(WAYLODE_ASSERTS)
  target_compile_definitions(waylode_warnings INTERFACE WAYLODE_ASSERTS=1)
endif()
if(WAYLODE_SANITIZE)
  target_compile_options(waylode_warnings INTERFACE
    -fsanitize=${WAYLODE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(waylode_warnings INTERFACE -fsanitize=${WAYLODE_SANITIZE})
endif()
if(WAYLODE_FUZZ)
  target_compile_options(waylode_warnings INTERFACE -fsanitize=fuzzer-no-link)
endif()
