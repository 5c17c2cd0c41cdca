#!/bin/sh
# SPDX-FileCopyrightText: The Waylode authors
# SPDX-License-Identifier: Apache-2.0
# run_each.sh FOLDER PATTERN [ARGUMENTS]: runs every program of FOLDER that matches PATTERN.
set -eu
folder=$1
pattern=$2
shift 2
# shellcheck disable=SC2231 # The pattern is meant to expand.
for program in "$folder"/$pattern; do
  [ -x "$program" ] || { echo "$0: no $pattern in $folder" >&2; exit 1; }
  echo "== ${program##*/}"
  "$program" "$@"
done
