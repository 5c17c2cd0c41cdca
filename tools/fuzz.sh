#!/bin/sh
# SPDX-FileCopyrightText: The Waylode authors
# SPDX-License-Identifier: Apache-2.0
# fuzz.sh SECONDS: runs each libFuzzer target for SECONDS on a copy of its corpus under
# build/fuzz/corpus/<target>, seeded from fuzz/corpus/<target>. A crash leaves its input in
# build/fuzz/crashes/<target>-... and ends the run; add the input to the corpus with the repair.
set -eu
seconds=$1
root=$(cd "$(dirname "$0")/.." && pwd)
mkdir -p "$root/build/fuzz/crashes"
found=
for program in "$root"/build/fuzz/bin/fuzz_*; do
  [ -x "$program" ] || continue
  found=1
  target=$(basename "$program"); target=${target#fuzz_}
  corpus="$root/build/fuzz/corpus/$target"
  mkdir -p "$corpus"
  seeds="$root/fuzz/corpus/$target"
  [ -d "$seeds" ] || seeds=
  echo "== $target, $seconds s"
  "$program" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -verbosity=0 \
    -print_final_stats=1 -artifact_prefix="$root/build/fuzz/crashes/$target-" \
    "$corpus" ${seeds:+"$seeds"}
done
[ -n "$found" ] || { echo "$0: no targets in build/fuzz/bin" >&2; exit 1; }
