#!/bin/sh
# SPDX-FileCopyrightText: The Waylode authors
# SPDX-License-Identifier: Apache-2.0
# install_packages.sh LIST: installs the Debian packages named in LIST that are not there yet.
# Quick and silent when nothing is missing; asks for root only when something is.
set -eu
list=$1
wanted=$(sed -e 's/#.*//' -e '/^[[:space:]]*$/d' "$list")
if ! command -v dpkg-query >/dev/null; then
  echo "$0: this is not a Debian system; install the equivalents of $list by hand" >&2
  exit 1
fi

# dpkg-query complains about names it has never heard of; those are missing like the others.
# shellcheck disable=SC2086 # One word per package.
present=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' $wanted 2>/dev/null |
  sed -n 's/^installed //p' || true)
missing=
for package in $wanted; do
  echo "$present" | grep -qxF "$package" || missing="$missing $package"
done
[ -z "$missing" ] && exit 0

if [ "$(id -u)" -eq 0 ]; then
  as_root=
elif command -v sudo >/dev/null; then
  as_root=sudo
else
  echo "$0: missing:$missing" >&2
  echo "$0: run this as root:  apt-get install$missing" >&2
  exit 1
fi

apt() {
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=300 "$@"
}

echo "Installing:$missing"
apt update || echo "$0: package lists not refreshed; trying with those at hand" >&2
# shellcheck disable=SC2086 # One word per package.
if ! apt install -y --no-install-recommends --no-remove $missing; then
  echo "$0: could not install:$missing" >&2
  if dpkg-query -W -f '${db:Status-Status}' libboost1.74-dev 2>/dev/null | grep -qx installed; then
    echo "$0: libboost1.81-dev excludes libboost1.74-dev, which is installed;" \
      "run as root:  apt-get remove libboost1.74-dev" >&2
  fi
  exit 1
fi
