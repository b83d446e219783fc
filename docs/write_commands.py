"""Write docs/commands.md from the parsers of the commands: ``python docs/write_commands.py``.

``--check`` writes nothing and ends with 1 when the page is not what the parsers say.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Iterator
from pathlib import Path

from beardyn_core.cli.main import COMMANDS, build_parser

PAGE = Path(__file__).with_name("commands.md")
HEAD = """# Commands

Written by `python docs/write_commands.py` from the parsers of the commands; `beardyn COMMAND --help` prints
the same.

Numbers are in the units of scene files (kN, mm, rpm); another unit is written behind: `80000N`. With
`--json` a command prints one object ([json.md](json.md)). Nothing that exists is replaced without
`--force`, and a file that a command reads never. Ctrl-C ends a command within two seconds, also while it
compiles, and it prints what it has kept.

| exit code | meaning |
|---|---|
| 0 | done |
| 2 | bad input, every mistake a sentence and nothing written; or a disk that is full |
| 3 | the model left its range of validity; the recording up to there is closed and readable |
| 3 | `beardyn fleet add`: files that cannot be read; the others are added |
| 10 | `beardyn monitor`, `beardyn fleet status`: the worst bearing is not diagnosable |
| 11 | `beardyn monitor`: the worst bearing has strikes that are unexplained |
| 12 | `beardyn monitor`: the worst bearing has a faulty part, or a hot box |
| 130 | interrupted |
"""


def plain(text: str) -> str:
    """Write a text of a parser as one line of a table."""
    text = " ".join(text.replace("%%", "%").split()).replace("|", "\\|").replace("<", "&lt;")
    return re.sub(r"(?<![\w`])(--[a-z][\w-]*)", r"`\1`", text)  # two hyphens would become a dash


def invocation(action: argparse.Action) -> str:
    """Write an argument as it is typed."""
    names = action.metavar or ("{" + ",".join(map(str, action.choices)) + "}" if action.choices else "")
    value = " ".join(names) if isinstance(names, tuple) else str(names)
    if action.nargs == 0:
        value = ""
    elif not value and action.option_strings:
        value = action.dest.upper()
    elif not value:
        value = action.dest
    more = "..." if action.nargs in ("*", "+") else ""
    return f"`{' '.join(filter(None, (', '.join(action.option_strings), value)))}{more}`"


def section(name: str, parser: argparse.ArgumentParser, purpose: str) -> Iterator[str]:
    """Write the section of one command."""
    yield f"### beardyn {name}"
    yield ""
    yield plain(parser.description or purpose)
    yield ""
    yield "| argument | meaning |"
    yield "|---|---|"
    for action in parser._actions:
        if not isinstance(action, argparse._HelpAction) and action.help != argparse.SUPPRESS:
            text = (action.help or "").replace("%(default)s", str(action.default))
            text = text.replace("%(default)g", f"{action.default:g}" if "%(default)g" in text else "")
            yield f"| {invocation(action)} | {plain(text)} |"
    yield ""
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            words = {each.dest: each.help or "" for each in action._choices_actions}
            for own, each in action.choices.items():
                for line in section(f"{name} {own}", each, words[own]):
                    yield f"#{line}" if line.startswith("### ") else line


def page() -> str:
    """Write the whole page."""
    parser = build_parser()
    (commands,) = (each for each in parser._actions if isinstance(each, argparse._SubParsersAction))
    purposes = dict(re.findall(r"^    (\w+) +(.+)$", parser.epilog or "", re.MULTILINE))
    lines = [HEAD]
    for heading, names in COMMANDS.items():
        lines += [f"## {heading.capitalize()}", ""]
        for name in names:
            lines += section(name, commands.choices[name], purposes[name])
    return "\n".join(lines).rstrip() + "\n"


def main(arguments: list[str]) -> int:
    """Write, or check."""
    if arguments == ["--check"]:
        return int(not PAGE.exists() or PAGE.read_text(encoding="utf-8") != page())
    PAGE.write_text(page(), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
