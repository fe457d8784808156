#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Breaks one line of the code at a time and looks whether the tests notice (scripts/mutate.sh runs it).

The table tests/mutants/mutants.tsv has a mutant a line, in columns between tabs:

    id           its name, unique
    file         the file, from the project's folder
    line         the text of the line, without the spaces around it, which must be there once
    replacement  what stands there instead
    compile      the sources to compile anew: of a header, some that include it; '-': the file itself
    program      the test program, without spheretree_test_
    filter       which of its tests ought to notice, as for --gtest_filter
    survives     empty; or why no test can notice

Sources are copied, broken and compiled in a temporary folder with the commands of build/test; the objects are
linked before the library, so a mutant costs one compilation and one link. A mutant is caught if a test fails,
crashes or does not end in time. It must compile, and the tests must pass without it.
"""
import argparse
import concurrent.futures
import contextlib
import csv
import datetime
import os
import pathlib
import random
import resource
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from typing import NamedTuple

ROOT = pathlib.Path(__file__).resolve().parents[1]
BUILD = ROOT / "build/test"
TABLE = ROOT / "tests/mutants/mutants.tsv"
COLUMNS = "id file line replacement compile program filter survives".split()
SECONDS = 90  # for the tests of one mutant; unbroken, they take a few
MEMORY = 8 << 30  # a wrong bound asks for more than there is
ENOUGH = 0.95  # of all mutants


class Mutant(NamedTuple):
    id: str
    file: str
    line: str
    replacement: str
    sources: list
    program: str
    filter: str
    survives: str

    @property
    def is_header(self):
        return self.file.endswith(".h")


class Result(NamedTuple):
    mutant: Mutant
    verdict: str  # caught, SURVIVES, or an error
    how: str
    seconds: float


class TableError(Exception):
    pass


def read_table(path):
    mutants = []
    with open(path, newline="") as file:
        lines = (line for line in file if line.strip() and not line.startswith("#"))
        for row in csv.reader(lines, delimiter="\t", quoting=csv.QUOTE_NONE):
            row += [""] * (len(COLUMNS) - len(row))
            if len(row) != len(COLUMNS):
                raise TableError(f"{path.name}: {row[0]} has {len(row)} columns, not {len(COLUMNS)}")
            sources = [row[1]] if row[4] == "-" else row[4].split()
            mutants.append(Mutant(*row[:4], sources, *row[5:]))
    return mutants


def check_table(mutants):
    """All that is wrong with the table, as sentences."""
    faults, seen = [], set()
    for mutant in mutants:
        if mutant.id in seen:
            faults.append(f"{mutant.id}: there are two of this name")
        seen.add(mutant.id)
        for name in [mutant.file, *mutant.sources]:
            if not (ROOT / name).is_file():
                faults.append(f"{mutant.id}: there is no file {name}")
        if mutant.is_header == (mutant.file in mutant.sources):
            faults.append(f"{mutant.id}: of a header, name sources to compile that include it; else put '-'")
        if (ROOT / mutant.file).is_file():
            lines = [line.strip() for line in (ROOT / mutant.file).read_text().splitlines()]
            if lines.count(mutant.line) != 1:
                faults.append(f"{mutant.id}: {mutant.file} has this line {lines.count(mutant.line)} "
                              f"times, not once: {mutant.line}")
        if mutant.line == mutant.replacement:
            faults.append(f"{mutant.id}: the replacement is the line itself")
    return faults


def ninja_command(target):
    """The words of the command that makes a target, the last of those that lead to it."""
    text = subprocess.run(["ninja", "-C", str(BUILD), "-t", "commands", target],
                          check=True, capture_output=True, text=True).stdout
    words = shlex.split(text.splitlines()[-1].strip())
    return [word for word in words if word not in (":", "&&")]


class Commands:
    """How build/test compiles its sources and links its programs."""

    def __init__(self):
        if not (BUILD / "build.ninja").is_file():
            raise TableError("build/test is not there, or not built with Ninja: "
                             "CMAKE_GENERATOR=Ninja cmake --preset test")
        self._compile = {}
        text = subprocess.run(["ninja", "-C", str(BUILD), "-t", "commands"],
                              check=True, capture_output=True, text=True).stdout
        for line in text.splitlines():
            if " -c " in line and line.endswith(".cc"):
                words = shlex.split(line)
                self._compile[words[-1]] = words
        self._link = {}

    def compile(self, source, copy, out, precompiled):
        """The command that compiles a copy of a source. What the copy lacks comes from the tree."""
        words = list(self._compile[str(ROOT / source)])
        kept, skip = [], False
        for word, following in zip(words, words[1:] + [""]):
            if skip:
                skip = False
            elif word in ("-o", "-MT", "-MF") or (not precompiled and "cmake_pch" in following):
                skip = True
            elif word not in ("-MD", "-Winvalid-pch", "-Werror"):
                kept.append(word)
        # Without ccache: nothing is compiled twice, so it is not worth a place there.
        launcher = [i for i, word in enumerate(kept) if word.endswith("ccache")]
        kept = kept[launcher[0] + 1:] if launcher else kept
        places = [f"-I{copy}", f"-I{copy}/tests", "-iquote", str((ROOT / source).parent)]
        return kept[:1] + places + kept[1:-1] + [str(copy / source), "-o", str(out)]

    def object_of(self, source):
        words = self._compile[str(ROOT / source)]
        return words[words.index("-o") + 1]

    def link(self, program, objects, out):
        """The command that links a program with other objects for some of its sources."""
        if program not in self._link:
            self._link[program] = ninja_command(program)
        words = list(self._link[program])
        words[words.index("-o") + 1] = str(out)
        if shutil.which("ld.gold"):  # a third of the time of ld
            words.insert(1, "-fuse-ld=gold")
        first = next(i for i, word in enumerate(words) if word.endswith(".o"))
        for source, built in objects.items():
            if self.object_of(source) in words:
                words[words.index(self.object_of(source))] = str(built)
            elif source.startswith(("openvdb_spheretree/", "cmd/")):  # in a library that is linked later
                words.insert(first, str(built))
        return words


def limit_child():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def run_tests(program, test_filter, folder, environment):
    """Whether tests failed, and how: the first one's name, a signal, or the time limit."""
    line = [str(program), f"--gtest_filter={test_filter}", "--gtest_fail_fast", "--gtest_brief=1"]
    tests = subprocess.Popen(line, cwd=folder, env={**os.environ, **environment}, stdin=subprocess.DEVNULL,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                             preexec_fn=limit_child, start_new_session=True)
    try:
        said, _ = tests.communicate(timeout=SECONDS)
    except subprocess.TimeoutExpired:
        return True, "does not end"
    finally:  # the program under test, too, where the tests did not wait for it
        with contextlib.suppress(ProcessLookupError):
            os.killpg(tests.pid, signal.SIGKILL)
        tests.wait()
    if tests.returncode == 0 and "  PASSED  ] 0 tests" in said:
        return True, "no such test"
    failed = [line.split("]")[1].split(",")[0].split("(")[0].strip()
              for line in said.splitlines() if line.startswith("[  FAILED  ]")]
    if failed:
        return True, failed[0]
    if tests.returncode != 0:
        return True, f"signal {-tests.returncode}" if tests.returncode < 0 else f"exit {tests.returncode}"
    return False, ""


class Workshop:
    """A worker's folder, in which mutants are made and tried one after another. A source is copied alone, and
    compiled with the precompiled header. For a header all is copied, so that no file finds the unbroken one."""

    def __init__(self, folder, commands):
        self.commands = commands
        self.folder = pathlib.Path(tempfile.mkdtemp(dir=folder))

    def copy_broken(self, mutant):
        copy = self.folder / "copy"
        shutil.rmtree(copy, ignore_errors=True)
        if mutant.is_header:
            for name in ("openvdb_spheretree", "cmd", "tests"):
                shutil.copytree(ROOT / name, copy / name, ignore=shutil.ignore_patterns("data"))
        path = copy / mutant.file
        path.parent.mkdir(parents=True, exist_ok=True)
        lines = (ROOT / mutant.file).read_text().splitlines(keepends=True)
        at = next(i for i, line in enumerate(lines) if line.strip() == mutant.line)
        lines[at] = lines[at].replace(mutant.line, mutant.replacement)
        path.write_text("".join(lines))
        return copy

    def build(self, mutant):
        """Compiles and links; the program to run, and its environment. None if the mutant does not compile."""
        copy, objects = self.copy_broken(mutant), {}
        for i, source in enumerate(mutant.sources):
            objects[source] = self.folder / f"{i}.o"
            line = self.commands.compile(source, copy, objects[source], precompiled=not mutant.is_header)
            if subprocess.run(line, cwd=BUILD, capture_output=True).returncode != 0:
                return None
        program = self.folder / "program"
        wants_command = mutant.program == "command"
        target = "vdb_spheretree" if wants_command else f"spheretree_test_{mutant.program}"
        line = self.commands.link(target, objects, program)
        if subprocess.run(line, cwd=BUILD, capture_output=True).returncode != 0:
            return None
        if not wants_command:
            return program, {}
        return BUILD / "bin/spheretree_test_command", {"SPHERETREE_TESTED_PROGRAM": str(program)}

    def verdict(self, mutant):
        start = time.monotonic()
        built = self.build(mutant)
        if built is None:
            return Result(mutant, "ERROR", "does not compile", time.monotonic() - start)
        failed, how = run_tests(built[0], mutant.filter, self.folder, built[1])
        verdict = "caught" if failed else "SURVIVES"
        return Result(mutant, verdict, how, time.monotonic() - start)


def unbroken_faults(mutants, folder):
    """The tests must pass, and exist, where nothing is broken."""
    faults = []
    for program, test_filter in sorted({(m.program, m.filter) for m in mutants}):
        failed, how = run_tests(BUILD / f"bin/spheretree_test_{program}", test_filter, folder, {})
        if failed:
            faults.append(f"without a mutant, {program} {test_filter} fails: {how}")
    return faults


def try_all(mutants, jobs, folder):
    commands = Commands()
    idle = [Workshop(folder, commands) for _ in range(jobs)]

    def one(mutant):
        workshop = idle.pop()
        try:
            result = workshop.verdict(mutant)
        finally:
            idle.append(workshop)
        print(f"{result.verdict:9}{mutant.id:28}{result.seconds:5.0f} s  {result.how}", flush=True)
        return result

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        return list(pool.map(one, mutants))


def summary(results):
    """Prints what there is to say at the end; the exit code."""
    caught = sum(result.verdict == "caught" for result in results)
    bad = [r for r in results if r.verdict == "ERROR" or (r.verdict == "SURVIVES" and not r.mutant.survives)]
    for result in results:
        if result.verdict == "SURVIVES" and result.mutant.survives:
            print(f"{result.mutant.id} survives: {result.mutant.survives}")
        elif result.verdict == "caught" and result.mutant.survives:
            print(f"{result.mutant.id} is caught, though the table explains why it survives")
    for result in bad:
        print(f"{result.mutant.id}: {result.how or 'no test notices'}\n"
              f"    {result.mutant.file}\n  - {result.mutant.line}\n  + {result.mutant.replacement}")
    print(f"{caught} of {len(results)} mutants caught, {len(bad)} without an explanation")
    return 0 if not bad and (caught >= ENOUGH * len(results) or len(results) < 40) else 1


def arguments():
    parser = argparse.ArgumentParser(prog="scripts/mutate.sh", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--draw", type=int, metavar="N", help="try N of those that must be caught, drawn by the date")
    parser.add_argument("--seed", default=datetime.date.today().isoformat(), help="draw by this, not by the date")
    parser.add_argument("--id", action="append", default=[], metavar="TEXT",
                        help="try those whose id, file or program begins with this; may be repeated")
    parser.add_argument("--check", action="store_true", help="only see whether the table fits the code")
    parser.add_argument("--jobs", type=int, default=1, help="mutants at a time")
    return parser.parse_args()


def main():
    options = arguments()
    mutants = read_table(TABLE)
    faults = check_table(mutants)
    if not faults and options.check:
        print(f"{len(mutants)} mutants fit the code")
        return 0
    if options.id:
        begin = tuple(options.id)
        mutants = [m for m in mutants if any(text.startswith(begin) for text in (m.id, m.file, m.program))]
    if options.draw:
        print(f"drawn by {options.seed}")
        expected = [m for m in mutants if not m.survives]
        mutants = random.Random(options.seed).sample(expected, min(options.draw, len(expected)))
    with tempfile.TemporaryDirectory(prefix="spheretree-mutants-") as folder:
        faults = faults or unbroken_faults(mutants, folder)
        if not faults:
            return summary(try_all(mutants, options.jobs, folder))
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except TableError as error:
        sys.exit(f"mutate.sh: {error}")
