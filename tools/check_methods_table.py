#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Waylode authors
# SPDX-License-Identifier: Apache-2.0
"""Holds docs/methods/README.md to the papers: every ID has one row, whose file and test exist.

check_methods_table.py [ROOT]: one line per fault; exit 1 if there is any. A row is
`| ID | what | file[, file] | test[, test] |`, a test being `Suite.Name` of GoogleTest or rapidcheck, or the
path of a test script. Features of the server, the console and the app say so instead of naming files.
"""
import re
import sys
from pathlib import Path

TABLE = "docs/methods/README.md"
ELSEWHERE = ("server", "console", "app")


def numbered(prefix: str, last: int) -> list[str]:
    return [f"{prefix}{number}" for number in range(1, last + 1)]


# Equations, steps, given parameters, experiments and system features of the four papers.
IDS = [
    *numbered("W-eq", 20), "W-1.1a", "W-1.1b", "W-1.1c", "W-1.2", "W-1.2.1", "W-2.2", "W-2.4", "W-3",
    *numbered("W-P", 5), *numbered("W-X", 4),
    *numbered("Z-eq", 26), "Z-1.1", "Z-2", "Z-2.1", *numbered("Z-P", 5), *numbered("Z-X", 4),
    *numbered("R-eq", 18), "R-2.2", "R-2.3", *numbered("R-P", 5), *numbered("R-X", 6),
    *numbered("D-eq", 8), "D-2.1", "D-2.2", "D-2.3", "D-2.4", "D-2.4.1", "D-2.4.2", "D-2.5", "D-2.6", "D-2.7", "D-4",
    "D-P", *numbered("D-X", 4),
    *numbered("S-", 19),
]
NOT_BUILT_HERE = set(numbered("S-", 8))


def rows_of(table: Path) -> list[tuple[int, list[str]]]:
    rows = []
    for number, line in enumerate(table.read_text(encoding="utf-8").splitlines(), 1):
        cells = [cell.strip() for cell in line.split("|")[1:-1]]
        if cells and re.fullmatch(r"[WZRDS]-[A-Za-z0-9.]+", cells[0]):
            rows.append((number, cells))
    return rows


def tests_of(root: Path) -> set[str]:
    """Suite.Name of every test in the sources."""
    declared = re.compile(r"\b(?:TEST|TEST_F|TEST_P|TYPED_TEST|RC_GTEST_PROP|RC_GTEST_FIXTURE_PROP)\s*\(\s*(\w+)\s*,\s*(\w+)")
    return {f"{suite}.{name}"
            for folder in ("engine", "cli", "tests")
            for source in sorted((root / folder).rglob("*.cpp"))
            for suite, name in declared.findall(source.read_text(encoding="utf-8"))}


def quoted(cell: str) -> list[str]:
    return re.findall(r"`([^`]+)`", cell)


def faults_of_row(root: Path, tests: set[str], cells: list[str]) -> list[str]:
    if len(cells) != 4:
        return [f"{cells[0]} needs four columns"]
    name, _, files, proofs = cells
    if name in NOT_BUILT_HERE and not quoted(files):
        return [] if files in ELSEWHERE else [f"{name} must name a file or one of {', '.join(ELSEWHERE)}"]
    faults = []
    if not quoted(files):
        faults.append(f"{name} names no file")
    faults += [f"{name}: no such file: {path}" for path in quoted(files) if not (root / path).is_file()]
    if not quoted(proofs):
        faults.append(f"{name} names no test")
    faults += [f"{name}: no such test: {test}" for test in quoted(proofs)
               if test not in tests and not ("/" in test and (root / test).is_file())]
    return faults


def check(root: Path, ids: list[str]) -> list[str]:
    table = root / TABLE
    if not table.exists():
        return [f"{TABLE} is gone"]
    rows = rows_of(table)
    tests = tests_of(root)
    faults = [f"{TABLE}:{number}: {fault}" for number, cells in rows
              for fault in faults_of_row(root, tests, cells)]
    named = [cells[0] for _, cells in rows]
    faults += [f"{TABLE}: {name} has {named.count(name)} rows, must have one"
               for name in ids if named.count(name) != 1]
    faults += [f"{TABLE}: {name} is no ID of the papers" for name in sorted(set(named) - set(ids))]
    return faults


def main() -> int:
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
    faults = check(root, IDS)
    print("\n".join(faults) if faults else f"methods table: {len(IDS)} IDs, clean")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
