"""A parser that answers a mistake with a sentence, not with the list of all options."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from typing import NoReturn

_ELSEWHERE = {
    "simulate": "bearing, speed, load and faults stand in the scene: "
    "`beardyn new SCENE -o mine.yaml` copies it",
}


class CommandParser(argparse.ArgumentParser):
    """The parser of `beardyn`, and by its class of every command."""

    def error(self, message: str) -> NoReturn:
        """End with the exit code of bad input."""
        self.exit(2, f"{self.prog}: error: {message}; `{self.prog} --help` lists what is possible\n")


def parse(parser: argparse.ArgumentParser, argv: Sequence[str] | None = None) -> argparse.Namespace:
    """Read a command line; a word that no command knows is answered by the command that was meant."""
    words = list(sys.argv[1:] if argv is None else argv)
    if not words:
        parser.print_help(sys.stderr)
        parser.exit(2)
    args, unknown = parser.parse_known_args(words)
    if unknown:
        command = words[0]
        hint = f"; {_ELSEWHERE[command]}" if command in _ELSEWHERE else ""
        parser.exit(
            2,
            f"{parser.prog} {command}: error: does not know {' '.join(unknown)}{hint}; "
            f"`{parser.prog} {command} --help` lists its options\n",
        )
    return args
