#!/bin/sh
# SPDX-FileCopyrightText: The Waylode authors
# SPDX-License-Identifier: Apache-2.0
# demo.sh: the whole way on simulated data, in build/demo: simulate a building with a surveyor and
# walkers, build its site from the surveyor's recordings, position the walkers, compare with truth.
set -eu
cd "$(dirname "$0")/.."
waylode=build/release/bin/waylode
demo=build/demo
say() { printf '\n== %s\n' "$*"; }
run() {
  echo "\$ $*"
  "$@"
}

rm -rf "$demo"
mkdir -p "$demo"

say "Simulate a building, a surveyor and three walkers"
run "$waylode" simulate testdata/demo/demo_scenario.toml --out "$demo/logs"

say "Build the site from the plan and the surveyor's recordings"
run "$waylode" site build "$demo/demo.wlsite" --name demo \
  --plan "$demo/logs/plan-F1.geojson" --plan "$demo/logs/plan-F2.geojson" "$demo"/logs/survey*.mcap

say "Position the walkers"
walkers=$(find "$demo/logs" -name '*.mcap' ! -name 'survey*' | sort)
for log in $walkers; do
  name=$(basename "$log" .mcap)
  run "$waylode" track "$log" --site "$demo/demo.wlsite" --method fused --format geojson \
    --out "$demo/$name.geojson"
done

say "Compare with truth"
# shellcheck disable=SC2086  # The names hold no spaces.
run "$waylode" evaluate mcap "$demo/demo.wlsite" $walkers \
  --methods wknn,fused,smoothed --out "$demo/evaluation.json" --report "$demo/report.html"

echo
echo "Open $demo/report.html in a browser."
