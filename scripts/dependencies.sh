# shellcheck shell=bash disable=SC2034
# SPDX-License-Identifier: Apache-2.0
# Sourced by the scripts of this project: the Debian packages it needs, and how it is built.
# Expects `set -euo pipefail`.

project_root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"

build_packages=(
    g++ cmake ninja-build ccache git
    libopenvdb-dev libopenvdb-tools libboost-iostreams-dev libtbb-dev libblosc-dev
    zlib1g-dev libdeflate-dev libpng-dev libhwy-dev libassimp-dev libjpeg-dev
    libcairo2-dev libnanovdb-dev nlohmann-json3-dev)
python_packages=(pybind11-dev python3-dev python3-numpy) # the Python module, beside build_packages
test_packages=(libgtest-dev libbenchmark-dev python3-matplotlib zsh groff-base dpkg-dev
    "${python_packages[@]}" python3-pytest python3-scipy python3-openvdb python3-pip python3-venv mypy)
# Readers of the files that are written for other tools; a test whose reader is missing is skipped. Beside these: install_npm.
reader_packages=(
    python3-yaml python3-meshio python3-open3d python3-vtk9 python3-ase
    libmujoco-dev liburdfdom-tools lammps yade nodejs blender libnanovdb-tools)
embree_packages=(libembree-dev) # what rays and points are timed against
browser_packages=(chromium) # for tests of pages, which are left out without
clang_packages=(clang llvm) # llvm: names of functions in what the sanitizers report

say() { printf '%s\n' "== $*" >&2; }
fail() { printf '%s\n' "${0##*/}: $*" >&2; exit 1; }

as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        "$@"
    elif command -v sudo >/dev/null; then
        sudo "$@"
    else
        fail "installing packages needs root, or sudo: as root, run: apt-get install ${missing[*]}"
    fi
}

# Installs those of the given packages that are missing. Where none is, neither network nor root is
# needed.
install_packages() {
    if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
        say "no apt here: using the libraries there are (on Debian they would be: $*)"
        return
    fi
    local missing=() package
    for package in "$@"; do
        # A package that was never seen makes dpkg-query fail; that is an answer too.
        if [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)" != installed ]
        then
            missing+=("$package")
        fi
    done
    if [ ${#missing[@]} -eq 0 ]; then
        return
    fi
    say "installing ${missing[*]}"
    as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=300 update \
        </dev/null >&2
    as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=300 \
        install --no-install-recommends "${missing[@]}" </dev/null >&2
}

# npm, for readers by node, where none came with nodejs. Debian has it in a package of its own; the nodejs of others has it
# inside and excludes that package. So this comes after nodejs is installed, not with it. Without npm two tests are skipped.
install_npm() {
    command -v npm >/dev/null || install_packages npm || say "no npm: readers of .usda and .glb are left out"
}

# Compilers at once: one a core, but no more than there is memory for (1.5 GiB each: OpenVDB's
# templates).
build_jobs() {
    local cores memory
    cores="$(nproc)"
    memory="$(awk '/^MemAvailable:/ { print int($2 / 1572864) }' /proc/meminfo)"
    if [ "$memory" -lt 1 ]; then memory=1; fi
    if [ "$memory" -lt "$cores" ]; then cores="$memory"; fi
    printf '%s\n' "$cores"
}

# build_preset PRESET [TARGET...]: configure and build. SPHERETREE_CMAKE_ARGUMENTS holds further
# arguments to the configure step, separated by spaces.
build_preset() {
    local preset="$1" target targets=()
    shift
    for target in "$@"; do targets+=(--target "$target"); done
    if [ -z "${CMAKE_GENERATOR:-}" ] && command -v ninja >/dev/null; then
        export CMAKE_GENERATOR=Ninja # only heeded where the folder was not configured before
    fi
    say "building preset '$preset' in build/$preset"
    # shellcheck disable=SC2086
    (cd "$project_root" && cmake --preset "$preset" ${SPHERETREE_CMAKE_ARGUMENTS:-} &&
        cmake --build "build/$preset" -j "${CMAKE_BUILD_PARALLEL_LEVEL:-$(build_jobs)}" \
            "${targets[@]}") </dev/null >&2
}

# What every run of a program with clang's sanitizers needs, and the compiler cache, which does not know that
# the list of what is ignored is part of what is compiled.
use_sanitizer_options() {
    local folder="$project_root/scripts/sanitizers"
    export CCACHE_EXTRAFILES="$folder/clang.ignore"
    export LSAN_OPTIONS="suppressions=$folder/leaks.supp:print_suppressions=0"
    export UBSAN_OPTIONS="halt_on_error=1:print_stacktrace=1:suppressions=$folder/undefined.supp"
}

# Real inputs, which are not part of the project: those of the folder SPHERETREE_DATA. What needs them
# is left out without.
find_data() {
    if [ -z "${SPHERETREE_DATA:-}" ] && [ -d "$project_root/../shared/data" ]; then
        SPHERETREE_DATA="$(cd "$project_root/../shared/data" && pwd)"
        export SPHERETREE_DATA
    fi
}

python=(/usr/bin/python3 -B) # Debian's, whichever comes first in PATH: it has Debian's matplotlib

# For scripts that draw: matplotlib, and the command, whose path becomes $program. It is built first,
# unless the variable VDB_SPHERETREE names one.
prepare_drawing() {
    if ! "${python[@]}" -c 'import matplotlib' 2>/dev/null; then
        install_packages python3-matplotlib || true
        "${python[@]}" -c 'import matplotlib' 2>/dev/null ||
            fail "drawing needs matplotlib: apt-get install python3-matplotlib"
    fi
    program="${VDB_SPHERETREE:-}"
    if [ -z "$program" ]; then
        install_packages "${build_packages[@]}"
        build_preset release vdb_spheretree
        program="$project_root/build/release/bin/vdb_spheretree"
    fi
}
