#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# MeshOptimize from nothing to a running filter on Debian 12 or 13.
#
#   ./bootstrap.sh demo    install what is missing, build, optimize a cracked pellet, show before and after
#   ./bootstrap.sh test    install what is missing, build, run every test
#   ./bootstrap.sh env     print the exports that let this shell use the build:  eval "$(./bootstrap.sh env)"
#
# MESHOPTIMIZE_BUILD   the build folder (default: build, in the source tree)
# MESHOPTIMIZE_OUTPUT  where demo writes (default: demo, in the build folder)
set -euo pipefail

source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build_dir=${MESHOPTIMIZE_BUILD:-$source_dir/build}
output_dir=${MESHOPTIMIZE_OUTPUT:-$build_dir/demo}
python_dir=$build_dir/lib/python3/site-packages

# The shortest lists that configure, build, load and render on a bare system (the rest comes as their dependencies).
core_packages=(g++ cmake ninja-build libeigen3-dev)  # all that Filters/Core needs
packages=(
  paraview-dev python3-paraview python3-dev libtet1.5-dev
  libopenmpi-dev libutfcpp-dev libdouble-conversion-dev liblzma-dev liblz4-dev
  xvfb libgl1-mesa-dri)
test_packages=(libgtest-dev libbenchmark-dev python3-meshio python3-tqdm python3-venv libglew-dev libfreetype-dev)

usage() { sed -n '3,11s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; }

as_root() {
  if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi
}

# What differs between releases: the Qt of ParaView, and that Debian 13 has no CalculiX (its test is skipped there).
choose_release() {
  local release
  release=$(. /etc/os-release && echo "${ID:-} ${VERSION_CODENAME:-}")
  case "$release" in
    "debian bookworm")
      packages+=(qtbase5-dev qttools5-dev qtxmlpatterns5-dev-tools)
      test_packages+=(calculix-ccx)
      ;;
    "debian trixie")
      packages+=(qt6-base-dev)
      test_packages+=(python3-pyvista)
      ;;
    *)
      echo "bootstrap.sh knows the packages of Debian 12 (bookworm) and 13 (trixie), and this is: $release" >&2
      echo "See \"Build\" in CONTRIBUTING.md: it says what to install." >&2
      exit 1
      ;;
  esac
}

missing() {
  local package
  for package in "$@"; do
    if [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" != installed ]; then
      echo "$package"
    fi
  done
}

# Unsafe means: dpkg does not wait until each file is on the disk. Some 430 packages come for ParaView, and wait minutes else.
# The disk is synchronized once, at the end.
apt_install() {
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
    -o DPkg::Lock::Timeout=600 -o Dpkg::Use-Pty=0 -o Dpkg::Options::=--force-unsafe-io "$@" > /dev/null
  sync
}

# Installs what is missing of the core's packages and the given ones. In a new build folder the core, which is most of the
# work, is compiled meanwhile.
prepare() {
  local first rest installing status=0
  mapfile -t first < <(missing "${core_packages[@]}")
  mapfile -t rest < <(missing "$@")
  [ $((${#first[@]} + ${#rest[@]})) -eq 0 ] && return
  echo "== installing $((${#first[@]} + ${#rest[@]})) packages: ${first[*]} ${rest[*]}"
  as_root apt-get update -qq
  [ ${#first[@]} -eq 0 ] || apt_install "${first[@]}"
  [ ${#rest[@]} -eq 0 ] && return
  apt_install "${rest[@]}" &
  installing=$!
  [ -f "$build_dir/build.ninja" ] || compile_core || status=$?
  wait "$installing"
  return $status
}

configure() {
  local log=$build_dir/configure.log
  mkdir -p "$build_dir"
  cmake -G Ninja -S "$source_dir" -B "$build_dir" -DCMAKE_BUILD_TYPE=Release \
    -DMESHOPTIMIZE_COMPILE_TOGETHER=ON "$@" > "$log" 2>&1 \
    || { tail -n 40 "$log"; return 1; }
}

# Takes a command that runs others, such as nice, if one is given.
compile() { "$@" cmake --build "$build_dir" --parallel "$(nproc)"; }

# Nicely: it is the installation, on one core, that all else waits for.
compile_core() {
  echo "== compiling the core meanwhile"
  configure -DMESHOPTIMIZE_CORE_ONLY=ON && compile nice -n 10
}

build() {
  if [ ! -f "$build_dir/build.ninja" ] || [ "$1" != "$(cat "$build_dir/.testing" 2>/dev/null)" ]; then
    echo "== configuring"
    configure -DMESHOPTIMIZE_CORE_ONLY=OFF -DBUILD_TESTING="$1" -DMESHOPTIMIZE_WITH_PARAVIEW=ON || exit 1
    echo "$1" > "$build_dir/.testing"
  fi
  echo "== building"
  compile
}

print_env() {
  local plugins=("$build_dir"/lib/paraview-*/plugins/MeshOptimize/MeshOptimize.so)  # of the newest ParaView, if there are more
  local plugin=${plugins[-1]}
  [ -f "$plugin" ] || { echo "nothing is built in $build_dir yet: ./bootstrap.sh demo does" >&2; exit 1; }
  cat <<END
export MESHOPTIMIZE_PLUGIN='$plugin'
export PV_PLUGIN_PATH='$(dirname "$plugin")'
export PYTHONPATH='$python_dir'"\${PYTHONPATH:+:\$PYTHONPATH}"
export PATH='$build_dir/bin'":\$PATH"
END
}

# Runs a command on a display of its own. The server finds a free number itself: xvfb-run -a can collide with another
# that starts at the same moment. -noreset: else the server starts anew whenever its last client leaves, and a program
# that connects just then is refused.
with_display() {
  local number_file server status=0
  number_file=$(mktemp)
  Xvfb -displayfd 9 -screen 0 1600x1280x24 -noreset -nolisten tcp 9> "$number_file" > /dev/null 2>&1 &
  server=$!
  for _ in $(seq 100); do
    [ -s "$number_file" ] && break
    sleep 0.1
  done
  [ -s "$number_file" ] || { echo "Xvfb does not start" >&2; exit 1; }
  DISPLAY=:$(cat "$number_file") "$@" || status=$?
  kill "$server"
  rm -f "$number_file"
  return $status
}

run_demo() {
  mkdir -p "$output_dir"
  eval "$(print_env)"
  with_display pvpython "$source_dir/ParaViewPlugin/Examples/demo.py" "$source_dir/Data/crack40.vtu" "$output_dir"
}

run_tests() {
  # OpenMPI refuses to run as root unless told twice.
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  with_display ctest --test-dir "$build_dir" --output-on-failure --parallel "$(nproc)"
}

case "${1:-}" in
  demo)
    choose_release
    prepare "${packages[@]}"
    build "$( [ -f "$build_dir/.testing" ] && cat "$build_dir/.testing" || echo OFF)"
    run_demo
    ;;
  test)
    choose_release
    prepare "${packages[@]}" "${test_packages[@]}"
    build ON
    run_tests
    ;;
  env) print_env ;;
  -h | --help | help) usage ;;
  *)
    usage >&2
    exit 2
    ;;
esac
