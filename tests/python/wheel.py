# SPDX-License-Identifier: Apache-2.0
"""The wheel of a build goes into a virtual environment, and is the module there; without network."""
import os
import pathlib
import subprocess
import sys
import venv

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PROGRAM = """
import pathlib, sys, spheretree, numpy
assert pathlib.Path(spheretree.__file__).is_relative_to(sys.prefix), spheretree.__file__
from importlib.metadata import files, version
assert version("spheretree") == spheretree.__version__
names = {str(file) for file in files("spheretree")}
assert {"spheretree/py.typed", "spheretree/_spheretree.pyi"} <= names, names
print(spheretree.build(numpy.ones((9, 9, 9), bool), [8, 1]))
"""


def pip(*arguments):
    subprocess.run([python, "-m", "pip", "--disable-pip-version-check", "--quiet", *arguments], check=True, env=environment)


environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
venv.create("venv", system_site_packages=True, with_pip=True)
python = pathlib.Path("venv/bin/python").absolute()
pip("wheel", "--no-index", "--no-deps", "--wheel-dir", "wheels", str(ROOT), "--config-settings",
    f"built={os.environ['SPHERETREE_BUILT']}")
wheels = list(pathlib.Path("wheels").iterdir())
assert len(wheels) == 1, wheels
pip("install", "--no-index", str(wheels[0]))
result = subprocess.run([python, "-B", "-c", PROGRAM], check=True, env=environment, capture_output=True, text=True)
print(wheels[0].name, result.stdout.strip())
pip("uninstall", "--yes", "spheretree")
sys.exit(subprocess.run([python, "-c", "import spheretree"], env=environment, stderr=subprocess.DEVNULL).returncode == 0)
