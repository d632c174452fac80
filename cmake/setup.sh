#!/usr/bin/env bash
# Installs what is missing (Debian 12 packages) and builds. Called by ./run and ./check:
#   cmake/setup.sh [--yes] PRESET [TARGET ...]
# Asks before it uses sudo, unless --yes is given or ROCI_YES is set. With ROCI_GEOTIFF=1 sites may be GeoTIFFs (GDAL),
# with ROCI_TIDY=1 clang-tidy is installed, too. Exits 0 when build/PRESET is up to date, 3 when a package is missing
# and cannot be installed.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
yes=${ROCI_YES:-}
if [[ ${1:-} == --yes ]]; then
  yes=1
  shift
fi
preset=$1
shift

packages=(
  g++ cmake ninja-build ccache git
  libfastrtps-dev libfastcdr-dev fastddsgen default-jre-headless   # Fast DDS and its IDL compiler
  cyclonedds-dev cyclonedds-tools                                  # Cyclone DDS and its IDL compiler
  libeigen3-dev libompl-dev libfcl-dev liburdfdom-dev              # motion
  coinor-libcbc-dev                                                # integer programs: which data goes with which downlink
  libyaml-cpp-dev libsqlite3-dev libssl-dev                        # missions, journal, trace digest
  libpng-dev                                                       # pictures of the ground tool
  nlohmann-json3-dev libcli11-dev libspdlog-dev libfmt-dev
  libgtest-dev libgmock-dev libbenchmark-dev
  python3                                                          # the field trial
  iproute2                                                         # network namespaces in the tests
  faketime                                                         # hosts whose clocks are wrong, in the tests
  systemd                                                          # systemd-analyze, which judges the units in the tests; without systemd-sysv it starts nothing
)
settings=()
if [[ ${ROCI_GEOTIFF:-0} != 0 ]]; then
  packages+=(libgdal-dev)
  settings+=(-DROCI_GEOTIFF=ON)
fi
if [[ ${ROCI_TIDY:-0} != 0 ]]; then
  packages+=(clang-tidy-19)
fi

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
done
if ((${#missing[@]})); then
  sudo=()
  if ((EUID != 0)); then
    command -v sudo >/dev/null || { echo "setup: as root, run: apt-get install ${missing[*]}" >&2; exit 3; }
    sudo=(sudo)
    if [[ -z $yes ]]; then
      echo "setup: these Debian packages are missing: ${missing[*]}" >&2
      if [[ ! -t 0 || ! -t 2 ]]; then
        echo "setup: nobody is there to ask; say --yes to install them with sudo apt-get, or install them by hand" >&2
        exit 3
      fi
      read -r -p "Install them with sudo apt-get? [y/N] " answer
      [[ $answer == [yY]* ]] || { echo "setup: nothing was installed" >&2; exit 3; }
    fi
  fi
  echo "setup: installing ${missing[*]}" >&2
  log=$(mktemp)
  if ! { "${sudo[@]}" apt-get update && DEBIAN_FRONTEND=noninteractive "${sudo[@]}" apt-get install -y --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
    tail -n 20 "$log" >&2
    echo "setup: apt-get failed (above); install by hand: ${missing[*]}" >&2
    exit 3
  fi
  rm -f "$log"
fi

cd "$root"
if [[ ! -f build/$preset/build.ninja ]]; then
  cmake --preset "$preset" "${settings[@]}" >&2
elif ((${#settings[@]})) && ! grep -q '^ROCI_GEOTIFF:BOOL=ON$' "build/$preset/CMakeCache.txt"; then
  cmake "${settings[@]}" "build/$preset" >&2
fi
# One line that changes on a terminal, and nothing at all where there is nothing, or next to nothing, to do.
show_build() {
  local line drawn=""
  while IFS= read -r line; do
    if [[ $line =~ ^\[[0-9]+/([0-9]+)\] ]]; then
      ((BASH_REMATCH[1] > 3)) || continue
      if [[ -t 2 ]]; then
        printf '\r\033[K%.78s' "$line" >&2
        drawn=1
      else
        printf '%s\n' "$line" >&2
      fi
    elif [[ ! $line =~ ^(ninja: (no work to do|Entering directory)|-- ) ]]; then
      printf '%s%s\n' "${drawn:+$'\n'}" "$line" >&2
      drawn=""
    fi
  done
  [[ -z $drawn ]] || echo >&2
}
ninja -C "build/$preset" "$@" 2>&1 | show_build
