#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""task_page.py on small pages: one that is fine, and one for every fault there is."""
import unittest

import task_page

GOOD = """# A page

Says what `-mesh2ls cover=1`, `units=mm`, `units=` and `format=ply` do, and what `level_0` is.

```sh
vdb_spheretree -read a.stl units=mm -mesh2ls dim=8 cover=1 \\
    -write '{$i}.vdb'   # not of format=usd
```

- More of it: `vdb_spheretree
  -help read`, and a list that goes on in a second line.

<!-- needs: numpy -->
```python
tree = spheretree.build(volume, axes="zyx", spheres=[8])
tree.export("a.ply", format="ply")
```

Arrays with `axes="zyx"`.
"""


class TaskPage(unittest.TestCase):
    def faults_with(self, *lines):
        return list(task_page.faults_of(GOOD + "\n" + "\n".join(lines) + "\n"))

    def require_fault(self, words, *lines):
        faults = self.faults_with(*lines)
        self.assertEqual(len(faults), 1, faults)
        self.assertIn(words, faults[0])

    def test_a_page_that_is_fine(self):
        self.assertEqual(self.faults_with(), [])

    def test_pieces_are_blocks_and_whole_commands_in_their_order(self):
        pieces = task_page.pieces_of(GOOD)
        self.assertEqual([piece.language for piece in pieces], ["sh", "sh", "python"])
        self.assertEqual([piece.needs for piece in pieces], [None, None, "numpy"])
        self.assertEqual(pieces[1].code, "vdb_spheretree -help read")
        self.assertTrue(pieces[0].code.startswith("vdb_spheretree -read a.stl"))

    def test_whole_commands_in_pipes_are_run(self):
        pieces = task_page.pieces_of("Or `vdb_tool -sphere -write stdout.vdb | vdb_spheretree -read stdin.vdb`.")
        self.assertEqual(len(pieces), 1)

    def test_indented_commands_are_faults(self):
        self.require_fault("not run", "    vdb_spheretree -read a.stl")
        self.require_fault("not run", "\tvdb_spheretree -read a.stl")

    def test_blocks_of_other_kinds_are_faults(self):
        self.require_fault("block of ''", "```", "vdb_spheretree -read a.stl", "```")
        self.require_fault("block of 'bash'", "```bash", "vdb_spheretree -read a.stl", "```")
        self.require_fault("not run", "  ```sh", "  vdb_spheretree -read a.stl")
        self.require_fault("not run", "~~~")
        self.require_fault("not run", "Also ``vdb_spheretree -read a.stl``.")

    def test_blocks_without_an_end_are_faults(self):
        self.assertIn("not run", self.faults_with("```sh", "vdb_spheretree -read a.stl")[0])

    def test_whole_commands_of_other_programs_are_faults(self):
        for command in ("pip install .", "blender -b", "./examples/quickstart.sh my.vdb"):
            self.require_fault("a command that is not run", f"Install it by `{command}`.")

    def test_actions_and_options_that_no_command_has_are_faults(self):
        for span in ("-check", "-mesh2ls cover=2", "-mesh2ls units=mm", "-read b.stl", "scale=", "units=cm",
                     "-read a.stl -check", "format=usd", 'axes="xyz"', "-mesh2ls\n  cover=2"):
            self.require_fault("no command of the page has", f"It takes `{span}`.")
        for span in ("-mesh2ls dim=8", "-mesh2ls cover=1 dim=", "-read a.stl units=mm -mesh2ls", "'{$i}'", "spheres=",
                     "-help read", "-mesh2ls\n  cover=1"):
            self.assertEqual(self.faults_with(f"It takes `{span}`."), [])

    def test_pages_longer_than_a_screen_are_faults(self):
        self.require_fault("lines are more than 45", *[""] * 30)

    def test_long_lines_are_faults_but_in_tables(self):
        self.require_fault("121 columns", "x" * 121)
        self.assertEqual(self.faults_with("x" * 120, "| " + "x" * 200), [])


if __name__ == "__main__":
    unittest.main()
