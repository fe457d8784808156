#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes a Debian package of a build, installs it into a root of its own, runs what it installs, and removes it:
# test_deb.sh BUILD FOLDER [PYTHON]. PYTHON is the one that a module was built for, if any was. Exit code 77: no dpkg here.
set -euo pipefail
build="$(realpath "$1")"
folder="$2"
examples="$(realpath "$(dirname "$0")/../../examples")"
python="${3:-}"
if ! command -v dpkg >/dev/null || ! command -v dpkg-shlibdeps >/dev/null; then
    echo "no dpkg-dev here (Debian: apt-get install dpkg-dev)"
    exit 77
fi
rm -rf "$folder"
mkdir -p "$folder/root/var/lib/dpkg"/{info,updates,triggers}
cd "$folder"
touch root/var/lib/dpkg/{status,available}

fail() { echo "$*" >&2; exit 1; }
package() { dpkg --root="$PWD/root" --force-not-root,depends --log=/dev/null "$@" >dpkg.txt 2>&1 || { cat dpkg.txt >&2; exit 1; }; }

cpack --config "$build/CPackConfig.cmake" -G DEB -B "$PWD" >cpack.txt 2>&1 || { cat cpack.txt >&2; exit 1; }
deb=$(ls ./*.deb)
dpkg-deb --field "$deb" Depends | grep -q libopenvdb || fail "the package does not ask for OpenVDB"
package --install "$deb"
for file in bin/vdb_spheretree share/man/man1/vdb_spheretree.1 \
    share/bash-completion/completions/vdb_spheretree share/zsh/vendor-completions/_vdb_spheretree \
    include/openvdb_spheretree/openvdb_spheretree.h; do
    [ -s "root/usr/$file" ] || fail "the package lacks /usr/$file"
done
cmake -S "$examples/consume" -B consume "-DCMAKE_PREFIX_PATH=$PWD/root/usr" >consume.txt 2>&1 ||
    { cat consume.txt >&2; fail "a project of somebody else's does not find the installed library"; }
grep -q "openvdb_spheretree_DIR:PATH=$PWD/root" consume/CMakeCache.txt || fail "it finds another library"
root/usr/bin/vdb_spheretree -quiet -generate ball voxels=2000 -spheretree spheres=8 -write tree.vdb tree.urdf
modules=root/usr/lib/python3/dist-packages
if [ -n "$python" ]; then
    # Of a build with the address sanitizer, its runtime is loaded first.
    LD_PRELOAD="${SPHERETREE_PRELOAD:-}" ASAN_OPTIONS=detect_leaks=0 PYTHONDONTWRITEBYTECODE=1 PYTHONPATH="$PWD/$modules" "$python" - "$PWD/$modules" <<'END' || fail "the installed Python module does not work"
import sys
import numpy, spheretree
assert spheretree.__file__.startswith(sys.argv[1]), spheretree.__file__
tree = spheretree.build(numpy.ones((9, 8, 7), bool), spheres=[8, 1])
assert [level.radii.size for level in tree.levels] == [8, 1], tree
assert spheretree.load("tree.vdb").levels[0].radii.size > 0
END
elif [ -e "$modules" ]; then
    fail "the package has a Python module that nobody asked for"
fi
if [ ! -s tree.vdb ] || [ ! -s tree.urdf ]; then fail "the installed program does not work"; fi
package --remove vdb-spheretree
left=$(find root -path root/var -prune -o -type f -print | head -3)
[ -z "$left" ] || fail "removing the package leaves: $left"
