#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds the floors of the library (scripts/floors.tsv) against its #include lines.

    scripts/check_includes.py [--arrows]     --arrows: print which folder includes which

Wrong are: a folder that the table does not have, or that is not there; an include of the same or of a higher floor; an
include of a header that is not there; a public header that includes a hidden one.
"""
import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
LIBRARY = ROOT / "openvdb_spheretree"
INCLUDE = re.compile(r'\s*#\s*include\s*([<"])([^>"]+)[>"]')


def read_floors():
    """folder -> (floor, what happens there), in the order of the table."""
    floors = {}
    for line in (ROOT / "scripts/floors.tsv").read_text().splitlines():
        if line and not line.startswith("#"):
            floor, folder, purpose = line.split("\t")
            floors[folder] = (int(floor), purpose)
    return floors


def public_headers():
    """Those that the library's CMakeLists.txt lists, as paths below openvdb_spheretree/."""
    text = (LIBRARY / "CMakeLists.txt").read_text()
    lists = re.findall(r"set\((?:core|extras)_headers\s+([^)]*)\)", text)
    return set(" ".join(lists).split())


def includes_of(path):
    """(line number, included path below openvdb_spheretree/) of the project's own includes."""
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        quote, name = match.groups()
        if quote == '"':
            yield number, (path.parent / name).resolve().relative_to(LIBRARY.resolve()).as_posix()
        elif name.startswith("openvdb_spheretree/"):
            yield number, name[len("openvdb_spheretree/"):]


def check(floors):
    """The arrows between folders, and what is wrong with them as sentences."""
    public = public_headers()
    arrows, errors = collections.Counter(), []
    files = sorted(p for p in LIBRARY.rglob("*") if p.suffix in (".h", ".cc"))
    for path in files:
        own = path.relative_to(LIBRARY).as_posix()
        folder = path.parent.relative_to(LIBRARY).as_posix()
        if folder != "." and folder not in floors:
            errors.append(f"{own}: the folder '{folder}' has no floor: give it a line in scripts/floors.tsv, "
                          "above all that it includes")
            continue
        for number, target in includes_of(path):
            at = f"openvdb_spheretree/{own}:{number}"
            to = pathlib.PurePosixPath(target).parent.as_posix()
            if not (LIBRARY / target).exists():
                errors.append(f"{at}: there is no openvdb_spheretree/{target}")
                continue
            if own in public and target not in public:
                errors.append(f"{at}: {target} is hidden, and {own} is installed: include it in the .cc file, "
                              "or list it among the public headers of openvdb_spheretree/CMakeLists.txt")
            if folder in (".", to) or to not in floors:
                continue
            arrows[folder, to] += 1
            if floors[to][0] >= floors[folder][0]:
                errors.append(f"{at}: {folder} (floor {floors[folder][0]}) includes {to} (floor {floors[to][0]}), which "
                              "is not below it: move what both need to a floor below both")
    for folder in floors:
        if not (LIBRARY / folder).is_dir():
            errors.append(f"scripts/floors.tsv: there is no folder openvdb_spheretree/{folder}: take its line out")
    for header in sorted(public):
        if not (LIBRARY / header).exists():
            errors.append(f"openvdb_spheretree/CMakeLists.txt: there is no public header {header}")
    return arrows, errors


def main():
    floors = read_floors()
    arrows, errors = check(floors)
    if "--arrows" in sys.argv[1:]:
        for folder in floors:
            below = [to for to in floors if (folder, to) in arrows]
            print(f"{folder}: {' '.join(below)}")
    for error in errors:
        print(error, file=sys.stderr)
    if errors:
        return 1
    print(f"{len(floors)} folders, {len(arrows)} arrows between them, none that runs up")
    return 0


if __name__ == "__main__":
    sys.exit(main())
