# SPDX-FileCopyrightText: The Waylode authors
# SPDX-License-Identifier: Apache-2.0
"""compile_case.py NAME SOURCE COMPILER...: with CASE_NAME defined, SOURCE must not compile and the
compiler must say what the block's `// expect: REGEX` says. `compiles_without_a_case` must compile.
"""
import re
import subprocess
import sys
from pathlib import Path


def main() -> int:
    name, source, *compiler = sys.argv[1:]
    control = name == "compiles_without_a_case"
    defines = [] if control else [f"-DCASE_{name}"]
    run = subprocess.run([*compiler, *defines, "-fsyntax-only", source], capture_output=True,
                         text=True, env={"PATH": "/usr/local/bin:/usr/bin:/bin", "LC_ALL": "C"})
    print(run.stderr)
    if control:
        return run.returncode
    if run.returncode == 0:
        print(f"CASE_{name} compiles")
        return 1
    text = Path(source).read_text(encoding="ascii")
    expected = re.search(rf"^#ifdef CASE_{name}\n\s*// expect: (.+)$", text, re.MULTILINE)
    if expected is None or not re.search(expected.group(1), run.stderr):
        print(f"CASE_{name} fails for another reason than expected")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
