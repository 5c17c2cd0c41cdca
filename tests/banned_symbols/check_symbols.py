# SPDX-FileCopyrightText: The Waylode authors
# SPDX-License-Identifier: Apache-2.0
"""Static libraries of the engine must not reference printing, exits, clocks or global randomness.

check_symbols.py NM [--expect SYMBOL... --] LIBRARY...: prints `library(object): symbol` for each
banned reference and exits 1; with --expect, succeeds when exactly these symbols are referenced.
"""
import re
import subprocess
import sys
from pathlib import Path

BANNED = re.compile(r"""
    std::(cout|cerr|clog|cin|wcout|wcerr) |
    (v|f|vf|d)?printf | __(v|f|vf|d)?printf_chk | f?puts | putchar | putc | fputc | perror |
    stdout | stderr | stdin |
    abort | _?exit | _Exit | quick_exit | at_quick_exit | atexit |
    s?rand | rand_r | s?random | [dejlmn]rand48 | getrandom | getentropy |
    std::random_device::.* |
    std::chrono::.*_clock::now\(\) |
    time | clock | clock_gettime | gettimeofday | localtime(_r)? | gmtime |
    (secure_)?getenv | setenv | putenv | unsetenv | setlocale |
    std::locale::global\(.*\) |
    system | popen | fork | exec[lv]p?e? | posix_spawnp? |
    socket | connect | bind | listen | getaddrinfo
    """, re.VERBOSE)

# (library, symbol): why it is there although we never call it.
ALLOWED: dict[tuple[str, str], str] = {}


def references(nm: str, library: Path) -> list[tuple[str, str]]:
    """(object, banned symbol) pairs of one library."""
    listing = subprocess.run([nm, "-C", "--undefined-only", str(library)], check=True,
                             capture_output=True, text=True).stdout
    found = []
    member = ""
    for line in listing.splitlines():
        if line.endswith(":"):
            member = line[:-1]
            continue
        symbol = re.sub(r"@.*", "", re.sub(r"^\s*[UwWv]\s+", "", line)).strip()
        if BANNED.fullmatch(symbol):
            found.append((member, symbol))
    return found


def main() -> int:
    nm, *rest = sys.argv[1:]
    expected = None
    if rest and rest[0] == "--expect":
        end = rest.index("--")
        expected = set(rest[1:end])
        rest = rest[end + 1:]
    libraries = [Path(name) for name in rest]
    if not libraries:
        print("no library to look at")
        return 1
    found = [(library.name, member, symbol) for library in libraries
             for member, symbol in references(nm, library)
             if (library.name, symbol) not in ALLOWED]
    for name, member, symbol in found:
        print(f"{name}({member}): {symbol}")
    print(f"{len(libraries)} libraries, {len(found)} banned references")
    if expected is not None:
        return 0 if {symbol for _, _, symbol in found} == expected else 1
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
