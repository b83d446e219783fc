"""Run the commands of the tutorial, and write the answers into its pages: ``python docs/write_tutorials.py``.

Names of pages may follow (``first_run``), else it is all of docs/tutorial. ``--check`` runs and writes
nothing: it ends with 1 when a command fails, or when an answer differs from the page in its words: numbers,
times, absolute paths and digests may differ. Blocks run in order, in one new folder a page: ``bash`` and
``python`` ones, the answer of each in the ``text`` block behind it if there is one; a block that begins with
``# NAME.py`` or ``# NAME.yaml`` becomes that file.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
from difflib import SequenceMatcher
from pathlib import Path

ROOT = Path(__file__).parents[1]
PAGES = ROOT / "docs" / "tutorial"
BLOCK = re.compile(r"```(bash|python|yaml)\n(.*?)```\n(\n```text\n.*?```\n)?", re.DOTALL)
FILE = re.compile(r"# (\w+\.(?:py|yaml))\b")
# 10 and more are answers of a monitor, such as a faulty bearing
COMMAND = f'beardyn() {{ "{sys.executable}" -m beardyn_core.cli.main "$@" || [ $? -ge 10 ]; }}\nset -e\n'
LONGEST_ANSWER = 40  # lines
ONCE = re.compile(
    r"beardyn: (compiling the kernels|kernels ready|choosing (the )?effects)"
)  # of a first run only

# what differs from run to run and machine to machine; a number stands alone or before its unit
TIME = re.compile(r"\b\d{4}-\d\d-\d\d(?:[T ]\d\d:\d\d(?::\d\d)?)?")
PATH = re.compile(r"(?<![\w.~])/(?:[\w.+-]+/)+[\w.+-]*")
DIGEST = re.compile(r"\b(?=[a-z]*\d)(?=\d*[a-f])[0-9a-f]{8,}\b")
NUMBER = re.compile(r"(?<![\w.])[-+\u2212]?\d+(?:[.,:]\d+)*(?:e[-+]?\d+)?")


def run(kind: str, text: str, folder: Path) -> str:
    """Run one block in a folder; its answer, without bars of progress."""
    named = FILE.match(text)
    if kind == "yaml" or named:
        if named is None:
            raise SystemExit(f"a block of {kind} names no file in its first line: {text[:60]!r}")
        (folder / named[1]).write_text(text, encoding="utf-8")
        return ""
    words = ["bash", "-c", COMMAND + text] if kind == "bash" else [sys.executable, "-c", text]
    paths = os.pathsep.join(filter(None, (str(ROOT), os.environ.get("PYTHONPATH"))))
    environment = {**os.environ, "PYTHONPATH": paths, "MPLBACKEND": "Agg"}
    done = subprocess.run(
        words,
        cwd=folder,
        env=environment,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        check=False,
    )
    if done.returncode:
        raise SystemExit(f"{text}\nended with {done.returncode}:\n{done.stdout}")
    return done.stdout


def answered(page: str, folder: Path) -> str:
    """Run the blocks of a page; the page with their answers."""

    def block(found: re.Match[str]) -> str:
        kind, text, answer = found.groups()
        said = [line for line in run(kind, text, folder).rstrip().splitlines() if not ONCE.match(line)]
        if not answer:
            return found[0]
        shown = said[:LONGEST_ANSWER] + ["..."] * (len(said) > LONGEST_ANSWER)
        lines = (line.rstrip().replace(str(folder), ".") for line in shown)
        return f"```{kind}\n{text}```\n\n```text\n" + "\n".join(lines) + "\n```\n"

    return BLOCK.sub(block, page)


def masked(line: str) -> str:
    """Leave of a line what is the same in every run: its words."""
    for pattern, name in ((TIME, "TIME"), (PATH, "PATH"), (DIGEST, "DIGEST"), (NUMBER, "#")):
        line = pattern.sub(name, line)
    return " ".join(line.split())


def differences(page: str, now: str) -> list[str]:
    """List the lines of a page whose words are no longer so, and those in their place."""
    old, new = page.splitlines(), now.splitlines()
    told = []
    matcher = SequenceMatcher(None, [masked(each) for each in old], [masked(each) for each in new], False)
    for kind, first, last, begin, end in matcher.get_opcodes():
        if kind != "equal":
            told += [f"line {first + 1}:", *(f"- {each}" for each in old[first:last])]
            told += [f"+ {each}" for each in new[begin:end]]
    return told


def main(arguments: list[str]) -> int:
    """Run the pages that are named, or all."""
    check = "--check" in arguments
    names = [each for each in arguments if each != "--check"]
    wrong = 0
    for path in [PAGES / f"{name}.md" for name in names] or sorted(PAGES.glob("*.md")):
        with tempfile.TemporaryDirectory() as folder:
            page = path.read_text(encoding="utf-8")
            now = answered(page, Path(folder))
        if not check:
            path.write_text(now, encoding="utf-8")
        elif told := differences(page, now):
            wrong += 1
            print(
                f"{path.name}: answers differ; run python docs/write_tutorials.py {path.stem}",
                *told,
                sep="\n",
            )
            continue
        print(f"{path.name}: every block ran")
    return int(wrong > 0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
