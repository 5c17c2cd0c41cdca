#!/bin/bash
# SPDX-FileCopyrightText: The Waylode authors
# SPDX-License-Identifier: Apache-2.0
# lint.sh [--quick|--all|--fix]: every check that needs no run of the program. clang-tidy looks at what
# changed since $WAYLODE_LINT_BASE (else since origin/main, else in the last commit), with --all at
# everything, with --quick at nothing; it needs build/ci built. --fix formats every source file instead.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 1
mode=${1:-changed}
failed=0

files() { git ls-files --cached --others --exclude-standard -- "$@" | while read -r file; do
  [ -f "$file" ] && echo "$file"; done | sort -u; }
report() { # report NAME LINES: nothing if there are no lines.
  [ -z "$2" ] && return
  printf '%s:\n%s\n' "$1" "$2" >&2
  failed=1
}
run() { # run COMMAND...: its failure is ours.
  "$@" || failed=1
}

cpp_files=$(files '*.cpp' '*.hpp')
if [ "$mode" = --fix ]; then
  echo "$cpp_files" | xargs -r clang-format-19 -i
  exit
fi

script_files=$(files '*.py' '*.sh' '*.cmake' '*.proto' '*.mjs' .ci/run Makefile)
run xargs -r clang-format-19 --dry-run --Werror <<<"$cpp_files"
report "not ASCII" "$(xargs -r grep -nP '[^\x00-\x7F]' /dev/null <<<"$cpp_files
$script_files")"
report "trailing blanks" "$(xargs -r grep -nE '[[:blank:]]+$' /dev/null <<<"$cpp_files
$script_files")"
report "no SPDX-License-Identifier: Apache-2.0 in the first lines" "$(
  while read -r file; do
    head -n 3 "$file" | grep -q 'SPDX-FileCopyrightText: The Waylode authors' &&
      head -n 3 "$file" | grep -q 'SPDX-License-Identifier: Apache-2.0' || echo "$file"
  done <<<"$cpp_files
$script_files")"
report "header without #pragma once" "$(files '*.hpp' | xargs -r grep -L '#pragma once')"
run tools/check_layers.py
run tools/check_docs_paths.py
run tools/check_methods_table.py
if command -v shellcheck >/dev/null; then
  run xargs -r shellcheck < <(files '*.sh' .ci/run)
fi

changed_sources() {
  local base=${WAYLODE_LINT_BASE:-}
  [ -n "$base" ] || base=$(git merge-base HEAD origin/main 2>/dev/null || git rev-parse HEAD)
  if [ "$base" = "$(git rev-parse HEAD)" ]; then base=$(git rev-parse -q --verify HEAD~1 || echo HEAD); fi
  { git diff --name-only "$base"; git ls-files --others --exclude-standard; } |
    grep -E '\.(cpp|hpp)$' | sed 's/\.hpp$/.cpp/' | sort -u
}

# Only what the build compiles can be checked.
compiled=$(sed -n 's/^ *"file": "\(.*\)",\{0,1\}$/\1/p' build/ci/compile_commands.json 2>/dev/null |
  grep -v "^$PWD/build/" | sed "s|^$PWD/||" | sort -u)
if [ "$mode" = --quick ]; then
  sources=
elif [ -z "$compiled" ]; then
  report "clang-tidy" "build/ci is not configured; run 'make lint'"
elif [ "$mode" = --all ]; then
  sources=$compiled
else
  sources=$(comm -12 <(changed_sources) <(echo "$compiled"))
fi
if [ -n "${sources:-}" ]; then
  echo "clang-tidy: $(wc -l <<<"$sources") files"
  xargs -P "$(nproc)" -n 1 clang-tidy-19 -p build/ci --quiet <<<"$sources" 2>&1 |
    grep -vE '^[0-9]+ warnings? generated' || true
  [ "${PIPESTATUS[0]}" -eq 0 ] || failed=1
fi

[ "$failed" -eq 0 ] && echo "lint: clean"
exit "$failed"
