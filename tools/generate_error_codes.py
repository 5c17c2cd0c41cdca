#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Waylode authors
# SPDX-License-Identifier: Apache-2.0
"""Writes core/error_code.hpp's table from contract/errors.toml: generate_error_codes.py IN OUT."""
import sys
import tomllib


def pascal(name: str) -> str:
    return "".join(part.capitalize() for part in name.split("_"))


def main() -> int:
    source, target = sys.argv[1:3]
    with open(source, "rb") as file:
        errors = tomllib.load(file)
    codes = [entry["code"] for entry in errors.values()]
    if len(codes) != len(set(codes)) or codes != sorted(codes):
        sys.exit(f"{source}: codes must be unique and ascending; they are append-only")
    lines = ["// Generated from contract/errors.toml. Do not edit.", "#pragma once", "",
             "#include <cstdint>", "#include <string_view>", "", "namespace waylode::core {", "",
             "/// What went wrong, as registered in contract/errors.toml.",
             "enum class ErrorCode : std::uint16_t {"]
    lines += [f"  k{pascal(name)} = {entry['code']},  ///< {entry['message']}."
              for name, entry in errors.items()]
    lines += ["};", "",
              "struct ErrorInfo {", "  ErrorCode code;", "  std::string_view name;",
              "  std::string_view message;", "  int exit_status;", "  int http_status;", "};", "",
              "inline constexpr ErrorInfo kErrorTable[] = {"]
    lines += [f'    {{ErrorCode::k{pascal(name)}, "{name}", "{entry["message"]}", '
              f'{entry["exit"]}, {entry["http"]}}},' for name, entry in errors.items()]
    lines += ["};", "", "}  // namespace waylode::core", ""]
    with open(target, "w", encoding="ascii") as file:
        file.write("\n".join(lines))
    return 0


if __name__ == "__main__":
    sys.exit(main())
