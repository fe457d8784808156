# SPDX-License-Identifier: Apache-2.0
"""What ctest runs: run.py volume|array_files|build|transforms|points|export|page|queries|scene|calls|doctest|types|wheel,
or run.py example PROGRAM.

It works in a folder of its own, and ends with 77 (skipped) where what a test is run by is not installed.
Python loads the libraries of SPHERETREE_PRELOAD first: a sanitizer's, of a module that is compiled with it.
"""
import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SKIPPED = 77


def require(*modules):
    missing = [module for module in modules if importlib.util.find_spec(module) is None]
    if missing:
        print(f"skipped: {sys.executable} has no {', '.join(missing)} (Debian: apt-get install "
              + " ".join({"mypy": "mypy"}.get(name, f"python3-{name}") for name in missing) + ")")
        sys.exit(SKIPPED)


def run_python(*arguments, folder, **variables):
    preload = os.environ.get("SPHERETREE_PRELOAD")
    if preload:
        variables["LD_PRELOAD"] = preload
    environment = dict(os.environ, **variables)
    return subprocess.run([sys.executable, "-B", *map(str, arguments)], cwd=folder, env=environment).returncode


def run(*arguments, folder):
    sys.exit(run_python(*arguments, folder=folder))


def run_example(program, folder):
    """A program ends with a file that was not there before, and is no empty one."""
    require("numpy", "matplotlib", "scipy")
    code = run_python(program, folder=folder, MPLBACKEND="Agg")
    files = [path for path in pathlib.Path(folder).iterdir() if path.stat().st_size > 0]
    print("files:", *sorted(path.name for path in files))
    keep = os.environ.get("SPHERETREE_KEEP_EXAMPLES")
    for path in files if keep else []:
        (pathlib.Path(keep) / path.name).write_bytes(path.read_bytes())
    sys.exit(code or (0 if files else "the program has left no file"))


def main(what, *arguments):
    with tempfile.TemporaryDirectory() as folder:
        if what == "example":
            run_example(*arguments, folder)
        elif what == "doctest":
            require("numpy", "pytest")
            run("-m", "pytest", "-q", "-p", "no:cacheprovider", "--doctest-modules", "--pyargs", "spheretree", folder=folder)
        elif what in ("types", "wheel") and "SPHERETREE_PRELOAD" in os.environ:
            print("skipped: the programs that this test runs know nothing of the sanitizer")
            sys.exit(SKIPPED)
        elif what == "types":
            require("numpy", "mypy")
            run("-m", "mypy", "--strict", "--cache-dir", folder, "-p", "spheretree", folder=folder)
        elif what == "wheel":
            require("numpy", "venv")
            run(HERE / "wheel.py", folder=folder)
        else:
            require("numpy", "pytest")
            run("-m", "pytest", "-q", "-p", "no:cacheprovider", "-rs", HERE / f"test_{what}.py", *arguments, folder=folder)


main(*sys.argv[1:])
