#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Waylode authors
# SPDX-License-Identifier: Apache-2.0
"""Paths in backticks, relative links and `make VERB`s in the front pages must exist.

check_docs_paths.py [ROOT]: one line `file:line: what is missing` each; exit 1 if there is any.
"""
import re
import sys
from pathlib import Path

PAGES = ["ARCHITECTURE.md", "CHANGELOG.md", "CONTRIBUTING.md", "README.md"]
# Made by a build, outside the tree, or placeholders of a command line.
NOT_IN_TREE = re.compile(r"^(build/|\.\./|/|~|https?:)|[<>$={} ]")


def is_path(text: str) -> bool:
    return ("/" in text.rstrip("/") or text.endswith(".md")) and not NOT_IN_TREE.search(text)


def missing_in(root: Path, page: Path, verbs: set[str]) -> list[str]:
    problems = []
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        quoted = re.findall(r"`([^`]+)`", line)
        linked = [target.split("#")[0] for target in re.findall(r"\]\(([^)]+)\)", line)]
        for text in [text for text in quoted + linked if is_path(text)]:
            if not any(root.glob(text.rstrip("/"))):
                problems.append(f"{page.relative_to(root)}:{number}: no such path: {text}")
        for verb in re.findall(r"\bmake ([a-z-]+)`", line):
            if verb not in verbs:
                problems.append(f"{page.relative_to(root)}:{number}: no such verb: make {verb}")
    return problems


def main() -> int:
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
    makefile = root / "Makefile"
    verbs = set(re.findall(r"^([a-z-]+):", makefile.read_text(encoding="utf-8"), re.MULTILINE)
                if makefile.exists() else [])
    problems = [problem for name in PAGES if (root / name).exists()
                for problem in missing_in(root, root / name, verbs)]
    print("\n".join(problems) if problems else "docs paths: clean")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
