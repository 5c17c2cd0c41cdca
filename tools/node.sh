#!/bin/sh
# SPDX-FileCopyrightText: The Waylode authors
# SPDX-License-Identifier: Apache-2.0
# node.sh [npm] ARGUMENTS: runs Node >= 20.19 (or its npm), the system's if new enough, else .venv's.
set -eu
venv_bin=$(cd "$(dirname "$0")/.." && pwd)/.venv/bin
new_enough='const [major, minor] = process.versions.node.split(".").map(Number);
  process.exit(major > 20 || (major === 20 && minor >= 19) ? 0 : 1)'

usable() { command -v node >/dev/null && command -v npm >/dev/null && node -e "$new_enough"; }

if ! usable; then
  PATH="$venv_bin:$PATH"
  if ! usable; then
    echo "$0: no Node >= 20.19; run 'make setup-test'" >&2
    exit 1
  fi
fi
program=node
if [ "${1:-}" = npm ]; then
  program=npm
  shift
fi
exec "$program" "$@"
