#!/bin/sh
# SPDX-FileCopyrightText: The Waylode authors
# SPDX-License-Identifier: Apache-2.0
# Installs what building Waylode and the demo need.
set -eu
tools=$(dirname "$0")
"$tools/install_packages.sh" "$tools/apt-packages-build.txt"
