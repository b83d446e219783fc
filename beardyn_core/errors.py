"""Errors a user sees: sentences with file, key, value and what is allowed."""

from __future__ import annotations

from collections.abc import Sequence


class InputError(Exception):
    """Bad input, with every problem found, one sentence each.

    Parameters
    ----------
    problems : sequence of str
        Each names the file, the key, the value and what is allowed.
    """

    def __init__(self, problems: Sequence[str] | str) -> None:
        self.problems = [problems] if isinstance(problems, str) else list(problems)
        super().__init__("\n".join(self.problems))


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
