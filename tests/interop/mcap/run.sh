#!/bin/sh
# SPDX-FileCopyrightText: The Waylode authors
# SPDX-License-Identifier: Apache-2.0
# run.sh HELPER: checks our MCAP files with @mcap/core, and its files with our reader.
set -eu
helper=$1
here=$(cd "$(dirname "$0")" && pwd)
if [ ! -d "$here/node_modules/@mcap/core" ]; then
  echo "$here/node_modules is missing: run make setup-test" >&2
  exit 1
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$helper" write "$folder"
"$here/../../../tools/node.sh" "$here/interop.mjs" check "$folder"
"$here/../../../tools/node.sh" "$here/interop.mjs" write "$folder"
for name in theirs_chunked_zstd theirs_chunked_plain theirs_unchunked; do
  "$helper" compare "$folder/$name.mcap" "$folder/ours_zstd.json"
done
