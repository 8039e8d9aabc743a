#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the plugin as a ParaView for servers, which has no Qt, would: filters and proxies, without what the window needs. Checks
# that nothing of it links Qt, and runs the tests of proxies and of several ranks with it.
#
#   Testing/server_only.sh [FOLDER]      default FOLDER: build-server-only in the source tree
set -euo pipefail
source_dir=$(cd "$(dirname "$0")/.." && pwd)
build=$(mkdir -p "${1:-$source_dir/build-server-only}" && cd "${1:-$source_dir/build-server-only}" && pwd)

cmake -G Ninja -S "$source_dir" -B "$build" -DCMAKE_BUILD_TYPE=Release -DMESHOPTIMIZE_WITH_WINDOW=OFF > "$build/configure.log" 2>&1 \
  || { tail -n 40 "$build/configure.log"; exit 1; }
cmake --build "$build" --parallel "${JOBS:-$(nproc)}"
plugin=$(find "$build/lib" -name MeshOptimize.so)
if readelf -d "$plugin" "$build"/lib/libvtk*.so | grep -i 'NEEDED.*Qt'; then
  echo "FAILED: Qt is linked"
  exit 1
fi
ctest --test-dir "$build" --output-on-failure -R 'TestProxies|RanksExample|RanksInputs|OptimizeRanks|ClientServerRanks'
