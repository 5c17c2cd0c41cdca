#!/bin/sh
# SPDX-FileCopyrightText: The Waylode authors
# SPDX-License-Identifier: Apache-2.0
# install_test.sh CMAKE BUILD_FOLDER COMPILER: installs the build under a temporary prefix, then
# configures, builds and runs the program of outside/ against that prefix alone.
set -eu
cmake=$1
build=$2
compiler=$3
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$cmake" --install "$build" --prefix "$work/prefix" >"$work/install.log" ||
  { cat "$work/install.log"; exit 1; }
if grep -rlF "$build" "$work/prefix/lib/cmake" "$work/prefix/include"; then
  echo "the files above name the build folder" >&2
  exit 1
fi
cp -r "$here/outside" "$work/outside"
"$cmake" -S "$work/outside" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_PREFIX_PATH="$work/prefix"
"$cmake" --build "$work/build"
"$work/build/outside"
