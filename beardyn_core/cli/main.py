"""The ``beardyn`` command: one module of this package for each subcommand.

Exit codes: 0 done, 2 bad input (nothing written) or a full disk, 3 the model left its range of
validity (recording closed and readable), 130 interrupted.
"""

from __future__ import annotations

import os
import signal
import sys
from contextlib import suppress
from typing import TYPE_CHECKING

from beardyn_core.base import interrupts
from beardyn_core.base.errors import InputError, ValidityError

# The rest is imported inside `main`, where a Ctrl-C while it loads is answered.
if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

DONE, BAD_INPUT, INVALID, INTERRUPTED = 0, 2, 3, 130
_ANNOUNCER = "beardyn command"
COMMANDS = {
    "start here": ("demo", "scenes", "new"),
    "simulate": ("simulate", "explain", "ladder", "warmup"),
    "recordings": ("import", "view", "report", "monitor", "estimate", "follow", "calibrate", "export"),
    "bearings and monitors": ("bearing", "structure", "trial", "contacts"),
    "populations": ("sweep", "baseline", "train"),
    "fleets": ("fleet",),
    "files": ("schema",),
}
"""The subcommands, each a module of this package, under the headings of the help."""


def command_names() -> list[str]:
    """List the subcommands in the order of the help."""
    return [name for names in COMMANDS.values() for name in names]


def module_of(command: str) -> str:
    """Name the module of a subcommand; a word of Python has an underscore behind it there."""
    from keyword import iskeyword

    return f"beardyn_core.cli.{command}{'_' * iskeyword(command)}"


def program_version() -> str:
    """Find the version that is installed."""
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version("beardyn")
    except PackageNotFoundError:
        return "of a checkout that is not installed"


def build_parser() -> argparse.ArgumentParser:
    """Build the parser of all subcommands; heavy modules are imported only by the one that runs."""
    import argparse
    import importlib

    from beardyn_core.cli.command_parser import CommandParser

    parser = CommandParser(
        prog="beardyn",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        description="Real-time digital twin of a railway axlebox bearing: runs of double-row tapered\n"
        "bearings, of spherical ones and of cylindrical pairs.",
    )
    parser.add_argument("--version", action="version", version=f"beardyn {program_version()}")
    subparsers = parser.add_subparsers(metavar="COMMAND", required=True, help="one of those below")
    for name in command_names():
        importlib.import_module(module_of(name)).add_parser(subparsers)
    purposes = {action.dest: action.help for action in subparsers._choices_actions}
    subparsers._choices_actions.clear()  # they are shown under headings instead
    lines = []
    for heading, names in COMMANDS.items():
        lines += [f"{heading}:", *(f"    {name:<12}{purposes[name]}" for name in names), ""]
    lines.append("`beardyn COMMAND --help` explains a command with its options, units and defaults.")
    parser.epilog = "\n".join(lines) + "\n"
    return parser


def main(argv: Sequence[str] | None = None) -> int:
    """Run a command line, that of the process when left out, and return the exit code."""
    _make_streams_printable()
    try:
        with interrupts.watching():
            from beardyn_core.cli.command_parser import parse

            args = parse(build_parser(), argv)
            _announce_on_stderr()
            code = int(args.run(args))
            sys.stdout.flush()  # a pipe or disk that refuses is reported here, not at exit
            return code
    except InputError as error:
        _complain(error.problems)
        return BAD_INPUT
    except ValidityError as error:
        _complain([str(error)])
        return INVALID
    except KeyboardInterrupt as interrupt:
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # the end is near; a second one would only be noise
        exec("")  # Python ends by the signal when the interrupt passed through an exec, unless one follows
        _complain([interrupts.sentence(interrupt)])
        return INTERRUPTED
    except BrokenPipeError:  # the reader of a pipe has gone
        _give_up_stdout()
        return DONE
    except OSError as error:
        _let_go_of_stdout()
        _complain([_explain_refusal(error)])
        return BAD_INPUT


def _make_streams_printable() -> None:
    """Let output go on where it is closed, or cannot show a letter: a run is worth more than its lines."""
    import io

    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:  # closed by the caller; else the next file that is opened would take its place
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115  as long as Python
        elif isinstance(stream, io.TextIOWrapper) and stream.errors in ("strict", "surrogateescape"):
            stream.reconfigure(errors="backslashreplace")


def _explain_refusal(error: OSError) -> str:
    """Say what the system refuses, with advice where it is about writing."""
    import errno

    what = error.strerror or str(error)
    advice = {
        **dict.fromkeys((errno.ENOSPC, errno.EDQUOT), "free space, or choose another place"),
        **dict.fromkeys((errno.EROFS, errno.EFBIG), "choose another place"),
    }.get(error.errno or 0)
    if advice is None:
        return f"{error.filename}: {what}" if error.filename else what
    return f"{error.filename or 'the output'}: {what}; {advice}"


def _let_go_of_stdout() -> None:
    """Print what is left, or keep the interpreter from complaining of it at exit."""
    try:
        sys.stdout.flush()
    except (OSError, ValueError):
        _give_up_stdout()


def _give_up_stdout() -> None:
    """Keep the interpreter from complaining at exit about what it could not print."""
    with suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _complain(problems: Sequence[str]) -> None:
    for problem in problems:
        print(f"beardyn: {problem}", file=sys.stderr)


def _announce_on_stderr() -> None:
    import logging

    logger = logging.getLogger("beardyn")
    for handler in logger.handlers:
        if handler.name == _ANNOUNCER and isinstance(handler, logging.StreamHandler):
            # of now, where a program calls twice; `setStream` would flush the old one, which may be closed
            handler.stream = sys.stderr
    if not logger.handlers:
        handler = logging.StreamHandler()
        handler.name = _ANNOUNCER
        handler.setFormatter(logging.Formatter("beardyn: %(message)s"))
        logger.addHandler(handler)
        logger.setLevel(logging.INFO)
        logger.propagate = False


if __name__ == "__main__":
    sys.exit(main())
