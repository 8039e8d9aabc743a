#!/usr/bin/env bash
# MeshOptimize from nothing to a running filter on Debian 12.
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
plugin_dir=$build_dir/lib/paraview-5.11/plugins/MeshOptimize

# The shortest list that configures, builds, loads and renders on a bare system (the rest comes as their dependencies).
packages=(
  g++ cmake ninja-build paraview-dev python3-paraview libeigen3-dev libtet1.5-dev
  libopenmpi-dev libutfcpp-dev libdouble-conversion-dev liblzma-dev liblz4-dev
  qtbase5-dev qttools5-dev qtxmlpatterns5-dev-tools
  xvfb libgl1-mesa-dri)
test_packages=(libgtest-dev calculix-ccx)

usage() { sed -n '2,10s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; }

as_root() {
  if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi
}

install_missing() {
  local missing=() package
  for package in "$@"; do
    if [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" != installed ]; then
      missing+=("$package")
    fi
  done
  [ ${#missing[@]} -eq 0 ] && return
  echo "== installing ${#missing[@]} packages: ${missing[*]}"
  as_root apt-get update -qq
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" > /dev/null
}

build() {
  local log=$build_dir/configure.log
  mkdir -p "$build_dir"
  if [ ! -f "$build_dir/build.ninja" ] || [ "${1:-}" != "$(cat "$build_dir/.testing" 2>/dev/null)" ]; then
    echo "== configuring"
    cmake -G Ninja -S "$source_dir" -B "$build_dir" -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING="$1" \
      -DMESHOPTIMIZE_WITH_PARAVIEW=ON > "$log" 2>&1 || { tail -n 40 "$log"; exit 1; }
    echo "$1" > "$build_dir/.testing"
  fi
  echo "== building"
  cmake --build "$build_dir" --parallel "$(nproc)"
}

print_env() {
  cat <<END
export MESHOPTIMIZE_PLUGIN='$plugin_dir/MeshOptimize.so'
export PV_PLUGIN_PATH='$plugin_dir'
export PYTHONPATH='$python_dir'"\${PYTHONPATH:+:\$PYTHONPATH}"
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
    install_missing "${packages[@]}"
    build "$( [ -f "$build_dir/.testing" ] && cat "$build_dir/.testing" || echo OFF)"
    run_demo
    ;;
  test)
    install_missing "${packages[@]}" "${test_packages[@]}"
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
