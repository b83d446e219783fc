"""Tables in Markdown."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

_RULES = {"l": "---", "r": "--:"}


def joined_rows(rows: Iterable[Iterable[object]]) -> str:
    """Write rows of cells, without a line break at the end."""
    return "\n".join(f"| {' | '.join(map(str, row))} |" for row in rows)


def markdown(head: Sequence[str], rows: Iterable[Iterable[object]], align: str = "") -> str:
    """Write a table, without a line break at the end.

    Parameters
    ----------
    head : sequence of str
        A heading for each column.
    rows : iterable
        The cells of each row.
    align : str
        ``l`` or ``r`` for each column, to the left or to the right; the last counts for all that follow,
        and ``l`` for all where none is given.
    """
    sides = (align or "l").ljust(len(head), (align or "l")[-1])
    lines = [joined_rows([head]), f"|{'|'.join(_RULES[side] for side in sides)}|", joined_rows(rows)]
    return "\n".join(line for line in lines if line)
