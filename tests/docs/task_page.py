# SPDX-License-Identifier: Apache-2.0
"""A page of docs/tasks: the pieces of it that are run, and what breaks its promises.

Pieces are blocks between ```sh, ```python or ```cpp and ```, and whole commands of vdb_spheretree within a sentence.
A page promises that all of its commands are run, and that it is a screen of text. So these are faults:

- code that is indented, or in a block of another kind: no test would run it;
- a whole command of another program within a sentence;
- an action or an option in a sentence that no piece has: `-check`, `-mesh2ls cover=1`, `units=mm`, `units=`;
- more than 45 lines, or more than 120 columns outside of tables.
"""

import re
from collections import namedtuple

MOST_LINES = 45
MOST_COLUMNS = 120

Piece = namedtuple("Piece", "language code needs")

BLOCK = r"^(?:<!-- needs: (?P<needs>\S+) -->\n)?```(?P<language>\w*)\n(?P<code>.*?)^```$"
SPAN = r"(?<!`)`(?P<span>(?:[^`\n]|\n(?!\n))+)`(?!`)"
PARTS = re.compile(f"{BLOCK}|{SPAN}", re.MULTILINE | re.DOTALL)
OUR_COMMAND = re.compile(r"(?:^|[ |])vdb_spheretree ")
OTHER_COMMAND = re.compile(r"(?:blender|cmake|ctest|npm|pip|python3?|\./\S+) ")
ACTION = re.compile(r"-[a-z][a-z0-9]*")
OPTION = re.compile(r"[a-z_]+=.*")


def parts_of(text):
    """Pieces, and spans between backticks as text on one line, in their order."""
    for match in PARTS.finditer(text):
        if match["span"] is None:
            yield Piece(match["language"], match["code"], match["needs"])
            continue
        span = " ".join(match["span"].split())
        yield Piece("sh", span, None) if OUR_COMMAND.search(span) else span


def pieces_of(text):
    return [part for part in parts_of(text) if isinstance(part, Piece)]


def actions_of(code, language="sh"):
    """Actions with the words behind them; words before the first action, and those of Python, are of an action without a name."""
    code = re.sub(r"(?m)(?:^|(?<=\s))#.*", "", code)
    code = re.sub(r"[\"'\\]", "", code)
    if language == "python":
        code = re.sub(r"[(),]", " ", code)
    actions = [("", set())]
    for word in code.split():
        if ACTION.fullmatch(word):
            actions.append((word, set()))
        else:
            actions[-1][1].add(word)
    return actions


def has_word(words, wanted):
    return wanted in words or (wanted.endswith("=") and any(word.startswith(wanted) for word in words))


def is_run(wanted, actions):
    """Whether one of the actions is the wanted one, with all of its words, or, without a name, has its options."""
    name, words = wanted
    if not name:
        words = [word for word in words if OPTION.fullmatch(word)]
        name = None
    return not (name or words) or any(
        name in (None, action) and all(has_word(theirs, word) for word in words) for action, theirs in actions)


def faults_of(text):
    """Sentences, none if all is well."""
    lines = text.splitlines()
    if len(lines) > MOST_LINES:
        yield f"{len(lines)} lines are more than {MOST_LINES}: what stands elsewhere in docs/ can be a link"
    for number, line in enumerate(lines, 1):
        if len(line) > MOST_COLUMNS and not line.startswith("|"):
            yield f"line {number} has {len(line)} columns, more than {MOST_COLUMNS}"
    without_blocks = re.sub(BLOCK, "", text, flags=re.MULTILINE | re.DOTALL)
    for line in without_blocks.splitlines():
        if line.startswith(("    ", "\t")) or "``" in line or "~~~" in line:
            yield f"code that is not run: it is to be a block of its own, of sh, python or cpp: {line.strip()}"

    pieces = pieces_of(text)
    for language in {piece.language for piece in pieces} - {"sh", "python", "cpp"}:
        yield f"code that is not run: a block of '{language}', and not of sh, python or cpp"
    actions = [action for piece in pieces for action in actions_of(piece.code, piece.language)]
    for span in parts_of(text):
        if isinstance(span, Piece):
            continue
        if OTHER_COMMAND.match(span):
            yield f"a command that is not run: `{span}`"
        elif not all(is_run(wanted, actions) for wanted in actions_of(span)):
            yield f"no command of the page has `{span}`"
