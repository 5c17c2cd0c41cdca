#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Waylode authors
# SPDX-License-Identifier: Apache-2.0
"""Holds #include lines and DEPENDS lists to the allowed-include table of ARCHITECTURE.md.

check_layers.py [ROOT]: one line `file:line: what is wrong` per violation; exit 1 if there is any.
"""
import re
import sys
from pathlib import Path

TABLE_HEADING = "| Module | May include |"
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]waylode/([a-z_]+)/([^">]+)[">]')
KEYWORDS = {"SOURCES", "HEADERS", "TESTS", "DEPENDS", "LIBRARIES", "PRIVATE_LIBRARIES"}


def read_table(architecture: Path) -> dict[str, set[str]]:
    """Module -> modules it may include, from the backticked names of the table's first columns."""
    allowed: dict[str, set[str]] = {}
    inside = False
    for line in architecture.read_text(encoding="utf-8").splitlines():
        if line.startswith(TABLE_HEADING):
            inside = True
        elif inside and not line.startswith("|"):
            break
        elif inside and not line.startswith("|--"):
            columns = line.split("|")
            names = set(re.findall(r"`([a-z_]+)`", columns[2]))
            for module in re.findall(r"`([a-z_]+)`", columns[1]):
                allowed[module] = names | {module}
    return allowed


def folders(root: Path, allowed: dict[str, set[str]]) -> dict[str, Path]:
    """Every module of the engine, and the table's rows that are folders of the project's root."""
    engine = root / "engine" / "waylode"
    found = {path.name: path for path in sorted(engine.iterdir()) if path.is_dir()}
    found |= {name: root / name for name in allowed if name not in found and (root / name).is_dir()}
    return found


def read_depends(cmake: Path) -> tuple[int, set[str]]:
    """Line number of the DEPENDS keyword (1 if absent) and the modules it lists."""
    text = re.sub(r"#.*", "", cmake.read_text(encoding="utf-8"))
    call = re.search(r"waylode_module\(([^)]*)\)", text)
    depends: set[str] = set()
    position = 0
    keyword = ""
    for word in re.finditer(r"\S+", call.group(1) if call else ""):
        if word.group() in KEYWORDS:
            keyword = word.group()
            position = word.start() if keyword == "DEPENDS" else position
        elif keyword == "DEPENDS":
            depends.add(word.group())
    return text.count("\n", 0, (call.start(1) if call else 0) + position) + 1, depends


def check_includes(root: Path, module: str, folder: Path, allowed: set[str]) -> list[str]:
    problems = []
    for path in sorted([*folder.rglob("*.hpp"), *folder.rglob("*.cpp")]):
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            other, rest = match.groups()
            place = f"{path.relative_to(root)}:{number}"
            if other not in allowed:
                problems.append(f"{place}: `{module}` may not include `{other}`")
            elif other != module and rest.startswith("detail/"):
                problems.append(f"{place}: waylode/{other}/detail is private to `{other}`")
    return problems


def check(root: Path) -> list[str]:
    allowed = read_table(root / "ARCHITECTURE.md")
    if not allowed:
        return [f"ARCHITECTURE.md:1: no table starting with '{TABLE_HEADING}'"]
    problems = []
    for module, folder in folders(root, allowed).items():
        cmake = folder / "CMakeLists.txt"
        if module not in allowed:
            if cmake.exists():
                problems.append(f"{cmake.relative_to(root)}:1: `{module}` has no row in ARCHITECTURE.md")
            continue
        problems += check_includes(root, module, folder, allowed[module])
        line, depends = read_depends(cmake) if cmake.exists() else (1, set())
        problems += [f"{cmake.relative_to(root)}:{line}: `{module}` may not depend on `{other}`"
                     for other in sorted(depends - allowed[module])]
    return problems


def main() -> int:
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
    problems = check(root)
    print("\n".join(problems) if problems else "layers: clean")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
