#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds what pages and comments refer to against what there is: scripts/check_docs.py

In README.md, CONTRIBUTING.md, docs/*.md and docs/tasks/*.md: links and their anchors; names between backticks that are files, folders
(also below openvdb_spheretree/, cmd/vdb_spheretree/ and tests/), or of the code's own (`UpperCamel`, `call()`). In the
comments of code and scripts: names of headers and of other files of the project, and `docs/page.md, "Section"`. That
docs/formats.md has every key and attribute that is written. And that the picture of the floors is that of today.
"""
import re
import subprocess
import sys

import check_includes
import draw_floors

ROOT = check_includes.ROOT
BASES = ["", "openvdb_spheretree/", "cmd/vdb_spheretree/", "tests/", "docs/"]
CODE = {".h", ".cc", ".py", ".sh", ".cmake", ".txt", ".tsv"}
LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
TICKS = re.compile(r"(?<!`)`([^`\n]+)`(?!`)")
FENCE = re.compile(r"^```.*?^```$", re.M | re.S)
PATH = re.compile(r"[\w.-]+(?:/[\w.-]+)*/?")
FILE = re.compile(r"\b(?:[\w-]+/)*[A-Za-z][\w-]*\.(?:h|cc|md|py|sh|tsv|cmake)\b")
SECTION = re.compile(r'(docs/[\w-]+\.md),?\s+"([^"]+)"')
# Names under which something is stored: keys of JSON and of metadata, attributes.
KEY = re.compile(r'(?:value|null|beginObject|beginArray|addAttribute<[\w:]+>|key|writeDegrees)\((?:json, )?"(\w+)"')
COLUMNS = re.compile(r"Columns\[\] = \{([^}]*)\}")
NAME = re.compile(r"[A-Z][a-z0-9]+(?:[A-Z]\w*)+|(?:\w+::)*[A-Za-z]\w+\(\)")
# Files of others that comments name: OpenVDB's headers, those of the standard library, and examples of names.
OTHERS = re.compile(r"openvdb/.*|LevelSetSphere\.h|VolumeToSpheres\.h|FastSweeping\.h|hwy/.*|sys/.*|FindOpenVDB\.cmake|[A-Z]\.md")


def tracked():
    """The project's files, as git knows them, with those that are new."""
    lines = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"], cwd=ROOT, check=True,
                           capture_output=True, text=True).stdout.splitlines()
    return [line for line in lines if (ROOT / line).is_file()]


def slug(heading):
    """The anchor that GitHub gives a heading."""
    return re.sub(r"[^\w\- ]", "", heading.lower().replace("`", "")).strip().replace(" ", "-")


def headings(page):
    return re.findall(r"^#+ (.+)$", FENCE.sub("", (ROOT / page).read_text()), re.M)


def comment_of(line, path):
    """The comment on a line of code; empty if there is none."""
    mark = "//" if path.endswith((".h", ".cc")) else "#"
    start = line.find(mark)
    return line[start:] if start >= 0 else ""


class Checker:
    def __init__(self):
        self.files = tracked()
        self.names = {path.rsplit("/", 1)[-1] for path in self.files}
        self.folders = {path[:i] for path in self.files for i, c in enumerate(path) if c == "/"}
        self.code = [f for f in self.files if not f.startswith("tests/data/") and any(f.endswith(e) for e in CODE)]
        self.texts = {f: (ROOT / f).read_text(errors="replace") for f in self.code + [".ci/run"]}
        self.words = set(re.findall(r"\w+", "\n".join(self.texts.values())))
        self.words.update(name.split(".")[0] for name in self.names)
        self.errors = []

    def exists(self, path):
        path = path.rstrip("/")
        return any(base + path in self.folders or base + path in self.files for base in BASES)

    def wrong(self, place, what):
        self.errors.append(f"{place}: {what}")

    def check_link(self, place, page, target):
        if "://" in target:
            return
        path, _, anchor = target.partition("#")
        path = path and (ROOT / page).parent.joinpath(path).resolve().relative_to(ROOT.resolve()).as_posix() or page
        if path not in self.files and path not in self.folders:
            self.wrong(place, f"links to {path}, which is not there")
        elif anchor and anchor not in map(slug, headings(path)):
            self.wrong(place, f"links to {path}#{anchor}, but no heading there gives that anchor")

    def check_ticks(self, place, text):
        if NAME.fullmatch(text):
            missing = [word for word in re.findall(r"\w+", text) if word not in self.words]
            if missing:
                self.wrong(place, f"`{text}`: there is no {missing[0]} in the code")
        elif FILE.fullmatch(text) and "/" not in text:
            if text not in self.names and not OTHERS.fullmatch(text):
                self.wrong(place, f"`{text}`: there is no such file")
        elif "/" in text and PATH.fullmatch(text) and not text.startswith(("build/", "openvdb/", "lib/")) \
                and "NAME" not in text:
            stem = any(self.exists(text + end) for end in ("", ".h", ".cc"))
            if not stem and text.split("/")[0] in {base for f in self.folders for base in f.split("/")}:
                self.wrong(place, f"`{text}`: there is no such file or folder")

    def check_page(self, page):
        text = (ROOT / page).read_text()
        fenced = "\n".join(FENCE.sub(lambda m: "\n" * m[0].count("\n"), text).splitlines())
        for number, line in enumerate(fenced.splitlines(), 1):
            for target in LINK.findall(line):
                self.check_link(f"{page}:{number}", page, target)
            for ticked in TICKS.findall(line):
                self.check_ticks(f"{page}:{number}", ticked)

    def check_code(self, path):
        text = self.texts[path]
        for number, line in enumerate(text.splitlines(), 1):
            comment = comment_of(line, path)
            if re.search(r"\bDESIGN\b", comment):
                self.wrong(f"{path}:{number}", "refers to DESIGN, which is not in the project")
            for name in FILE.findall(re.sub(r"https?:\S+", "", comment)):
                if name.rsplit("/", 1)[-1] not in self.names and not OTHERS.fullmatch(name):
                    self.wrong(f"{path}:{number}", f"names {name}, which is not there")
        joined = re.sub(r"\s*\n\s*(?:///?|#)\s*", " ", text)
        for page, section in SECTION.findall(joined):
            if page not in self.files or section not in headings(page):
                self.wrong(path, f'refers to {page}, "{section}": there is no such section')

    def check_formats(self):
        """That every name under which something is stored is described."""
        page = (ROOT / "docs/formats.md").read_text()
        described = set(re.findall(r"\w+", " ".join(TICKS.findall(page))))
        for start in re.findall(r"`(spheretree_\w+?)_?`((?:, `_\w+`)+)", page):  # `a_b`, `_c`: a_c too
            stem = start[0].rsplit("_", 1)[0]
            described.update(stem + end for end in re.findall(r"`(_\w+)`", start[1]))
        for path, text in self.texts.items():
            if not path.startswith(("openvdb_spheretree/", "cmd/")):
                continue
            keys = re.findall(r'"(spheretree_\w+)"', text)
            if path.startswith(("openvdb_spheretree/store/", "cmd/vdb_spheretree/report/")):
                keys += KEY.findall(text) + re.findall(r'"(\w+)"', " ".join(COLUMNS.findall(text)))
            for key in keys:
                if key not in described and not key.endswith("_"):
                    self.wrong(path, f"stores {key}, which docs/formats.md does not describe")


def main():
    checker = Checker()
    pages = [f for f in checker.files if f in ("README.md", "CONTRIBUTING.md") or re.fullmatch(r"docs/(tasks/)?[\w-]+\.md", f)]
    for page in pages:
        checker.check_page(page)
    for path in checker.texts:
        if path != "scripts/check_docs.py":
            checker.check_code(path)
    checker.check_formats()
    for error in checker.errors:
        print(error, file=sys.stderr)
    floors = check_includes.read_floors()
    picture_is_old = draw_floors.is_old(floors, check_includes.check(floors)[0])
    if checker.errors or picture_is_old:
        return 1
    print(f"{len(pages)} pages and the comments of {len(checker.texts)} files refer to what is there")
    return 0


if __name__ == "__main__":
    sys.exit(main())
