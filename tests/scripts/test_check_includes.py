#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""scripts/check_includes.py on small libraries: one that is fine, and one for every error there is."""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts/check_includes.py"
FLOORS = "# floor\tfolder\tpurpose\n3\troof\tthe top\n2\troom\tthe middle\n2\tside\tbeside it\n1\tbase\tthe bottom\n"
INCLUDE = "#include <openvdb_spheretree/{}>\n"
QUOTED = '#include "{}"\n'
SYSTEM = "#include <vector>\n"
LIBRARY = {
    "CMakeLists.txt": "set(core_headers\n    roof/Roof.h\n    room/Room.h)\nset(extras_headers base/Base.h)\n",
    "roof/Roof.h": INCLUDE.format("room/Room.h"),
    "roof/Roof.cc": QUOTED.format("Roof.h") + QUOTED.format("../base/Hidden.h") + SYSTEM,
    "room/Room.h": INCLUDE.format("base/Base.h"),
    "side/Side.h": INCLUDE.format("base/Hidden.h"),
    "base/Base.h": "#include <cstdint>\n",
    "base/Hidden.h": "",
}


class CheckIncludes(unittest.TestCase):
    def run_with(self, changes=None, floors=FLOORS, arguments=()):
        """The script's exit code, output and errors; a change to None removes the file."""
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "scripts").mkdir()
            shutil.copy(SCRIPT, root / "scripts")
            (root / "scripts/floors.tsv").write_text(floors)
            for name, text in {**LIBRARY, **(changes or {})}.items():
                path = root / "openvdb_spheretree" / name
                path.parent.mkdir(parents=True, exist_ok=True)
                if text is not None:
                    path.write_text(text)
            done = subprocess.run([sys.executable, root / "scripts" / SCRIPT.name, *arguments],
                                  capture_output=True, text=True)
            return done.returncode, done.stdout, done.stderr

    def expect_error(self, *parts, **arguments):
        code, _, errors = self.run_with(**arguments)
        self.assertEqual(code, 1)
        self.assertEqual(len(errors.splitlines()), 1, errors)
        for part in parts:
            self.assertIn(part, errors)

    def test_a_library_that_keeps_its_floors_is_fine(self):
        code, output, errors = self.run_with(arguments=["--arrows"])
        self.assertEqual((code, errors), (0, ""))
        self.assertIn("roof: room base\n", output)
        self.assertIn("4 folders, 4 arrows", output)

    def test_an_include_that_runs_up_is_an_error(self):
        text = SYSTEM + QUOTED.format("../roof/Roof.h")
        self.expect_error("room/Room.cc:2", "room (floor 2) includes roof (floor 3)", changes={"room/Room.cc": text})

    def test_an_include_of_the_same_floor_is_an_error(self):
        text = INCLUDE.format("side/Side.h")
        self.expect_error("room/Room.cc:1", "room (floor 2) includes side (floor 2)", changes={"room/Room.cc": text})

    def test_a_folder_that_the_table_does_not_have_is_an_error(self):
        self.expect_error("new/File.cc", "the folder 'new' has no floor", "floors.tsv", changes={"new/File.cc": ""})

    def test_a_folder_of_the_table_that_is_not_there_is_an_error(self):
        self.expect_error("there is no folder openvdb_spheretree/cellar", floors=FLOORS + "0\tcellar\tnothing\n")

    def test_an_include_of_a_header_that_is_not_there_is_an_error(self):
        text = INCLUDE.format("base/Gone.h")
        self.expect_error("roof/Other.cc:1", "there is no openvdb_spheretree/base/Gone.h",
                          changes={"roof/Other.cc": text})

    def test_a_public_header_that_is_not_there_is_an_error(self):
        text = LIBRARY["CMakeLists.txt"] + "set(extras_headers base/Gone.h)\n"
        self.expect_error("CMakeLists.txt", "there is no public header base/Gone.h", changes={"CMakeLists.txt": text})

    def test_a_public_header_that_includes_a_hidden_one_is_an_error(self):
        text = INCLUDE.format("base/Hidden.h")
        self.expect_error("room/Room.h:1", "base/Hidden.h is hidden", changes={"room/Room.h": text})


if __name__ == "__main__":
    unittest.main()
