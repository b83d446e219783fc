"""Errors a user sees: sentences with file, key, value and what is allowed."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import TypeVar

_Made = TypeVar("_Made")
_COMMAND_OR_OPTION = re.compile(r"`[^`]*`|(?<!install )(?<![\w-])--([a-z][a-z0-9]*(?:-[a-z0-9]+)*)")


class InputError(Exception):
    """Bad input, with every problem found, one sentence each.

    The command prints ``problems``; as text, for programs, options are named as arguments (`in_python`).

    Parameters
    ----------
    problems : sequence of str
        Each names the file, the key, the value and what is allowed; options as on the command line.
    """

    def __init__(self, problems: Sequence[str] | str) -> None:
        self.problems = [problems] if isinstance(problems, str) else list(problems)
        super().__init__("\n".join(self.problems))

    def __str__(self) -> str:
        return in_python("\n".join(self.problems))


def in_python(sentence: str) -> str:
    """Name options as arguments: ``--rate-hz`` is ``rate_Hz``. Commands in backticks and of ``apt`` stay.

    Examples
    --------
    >>> in_python("give --rate-hz; --force replaces it; `beardyn train --bearing FILE` makes one")
    'give rate_Hz; force=True replaces it; `beardyn train --bearing FILE` makes one'
    >>> in_python("apt-get install --no-install-recommends xvfb")
    'apt-get install --no-install-recommends xvfb'
    """

    def argument(found: re.Match[str]) -> str:
        if found[1] is None:
            return found[0]
        if found[1] == "force":
            return "force=True"
        return re.sub(r"_hz$", "_Hz", found[1].replace("-", "_"))

    return _COMMAND_OR_OPTION.sub(argument, sentence)


def collect_problems(problems: list[str], make: Callable[[], _Made]) -> _Made | None:
    """Make something; add what is wrong with its input to the problems, and give `None` then."""
    try:
        return make()
    except InputError as error:
        problems += error.problems
        return None


class ValidityError(Exception):
    """The model left its range of validity while it ran.

    Parameters
    ----------
    sentence : str
        What happened, at which simulated time, and what to do about it.
    block : object, optional
        The block in which it happened; it has been computed and may be shown.
    """

    def __init__(self, sentence: str, block: object | None = None) -> None:
        super().__init__(sentence)
        self.block = block


def separator_problem(header: str) -> str:
    """Say what separates the columns of a table in place of commas, by its first line; empty: nothing."""
    between = {";": "semicolons", "\t": "tabs", "|": "bars"}
    sign = next((sign for sign in between if sign in header and "," not in header), None)
    return (
        f"its columns are separated by {between[sign]}; separate them by commas, and write decimal numbers "
        "with a point"
        if sign
        else ""
    )
