#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# clang-tidy, with the checks of .clang-tidy, over all sources of Filters and the plugin, or the given ones. Exit status 1 if it warns.
#
#   Testing/tidy.sh [FILE ...]
#
# Needs clang-tidy, and a folder that is configured with -DCMAKE_EXPORT_COMPILE_COMMANDS=ON (MESHOPTIMIZE_BUILD, default: build-tidy,
# which is configured here). Not a test: it takes long.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build_dir=${MESHOPTIMIZE_BUILD:-build-tidy}
[ -f "$build_dir/compile_commands.json" ] \
  || cmake -G Ninja -S . -B "$build_dir" -DCMAKE_BUILD_TYPE=Release -DCMAKE_EXPORT_COMPILE_COMMANDS=ON > /dev/null
[ $# -gt 0 ] || mapfile -t sources < <(git ls-files 'Filters/*.cpp' 'Filters/*.cxx' ':(glob)ParaViewPlugin/*.cxx' 'ParaViewPlugin/Toolbar/*.cxx')
[ $# -eq 0 ] || sources=("$@")
printf '%s\n' "${sources[@]}" | xargs -P "$(nproc)" -n 1 clang-tidy -p "$build_dir" --quiet --warnings-as-errors='*' 2> /dev/null
