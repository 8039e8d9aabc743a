#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds and tests against plain VTK (no ParaView) beside ParaView's stack: VTK 9.1 on Debian 12, 9.3 on Debian 13.
#
#   Testing/plain_vtk.sh [FOLDER]      default FOLDER: build-plain-vtk in the source tree
#
# libvtk9-dev and python3-paraview cannot be installed together, so VTK's packages are only downloaded and unpacked
# into FOLDER/prefix (no root needed); what they need besides (apt-get install libtbb-dev ...) comes along the same way.
set -euo pipefail
source_dir=$(cd "$(dirname "$0")/.." && pwd)
work=$(mkdir -p "${1:-$source_dir/build-plain-vtk}" && cd "${1:-$source_dir/build-plain-vtk}" && pwd)
multiarch=$(dpkg-architecture -qDEB_HOST_MULTIARCH 2>/dev/null || gcc -print-multiarch)
prefix=$work/prefix
lib=$prefix/usr/lib/$multiarch

if [ ! -d "$lib" ]; then
  mkdir -p "$work/debs" "$prefix"
  library=$(apt-cache depends libvtk9-dev | grep -o 'libvtk9\.[0-9]*')
  (cd "$work/debs" && apt-get download libvtk9-dev "$library" vtk9 python3-vtk9 libtbb-dev libtbb12 libtbbmalloc2 libtbbbind-2-5)
  for deb in "$work"/debs/*.deb; do dpkg -x "$deb" "$prefix"; done
fi
vtk=("$lib"/cmake/vtk-9.*)

export LD_LIBRARY_PATH=$lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
export PYTHONPATH=$prefix/usr/lib/python3/dist-packages${PYTHONPATH:+:$PYTHONPATH}
# VTK's package lists the Qt libraries of packages that were left out: thousands of harmless lines go to the log.
cmake -G Ninja -S "$source_dir" -B "$work/build" -DCMAKE_BUILD_TYPE=Release -DMESHOPTIMIZE_WITH_PARAVIEW=OFF \
  -DVTK_DIR="${vtk[0]}" -DCMAKE_PREFIX_PATH="$prefix/usr" -DCMAKE_LIBRARY_PATH="$lib" > "$work/configure.log" 2>&1 \
  || { tail -n 40 "$work/configure.log"; exit 1; }
grep -- '-- MeshOptimize: ' "$work/configure.log"
cmake --build "$work/build" --parallel "$(nproc)"
ctest --test-dir "$work/build" --output-on-failure
