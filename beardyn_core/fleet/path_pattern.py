"""Identity from the path of a file, by a pattern such as ``{vehicle}/{axle}_{side}/{date}.csv``."""

from __future__ import annotations

import re
from pathlib import PurePath

from beardyn_core.base.errors import InputError

FIELDS = {
    **dict.fromkeys(("vehicle", "axle", "side", "bearing", "sensor", "train", "mileage_km"), r"[^/]+?"),
    "date": r"[^/]+?",
    "any": r"[^/]*?",
}
"""Names in braces; `date` is the column `time`, `any` is left aside."""


class PathPattern:
    """A pattern of paths, read from its end: folders above it may be any.

    Parameters
    ----------
    text : str

    Raises
    ------
    InputError
        With every mistake in it.
    """

    def __init__(self, text: str) -> None:
        self.text = text
        problems, expression, seen = [], "", set()
        for literal, name in re.findall(r"([^{}]*)(?:\{([^{}]*)\})?", text):
            expression += re.escape(literal)
            if not name:
                continue
            if name not in FIELDS:
                problems.append(f"--pattern {text}: has {{{name}}}; allowed are {', '.join(FIELDS)}")
            elif name == "any":
                expression += FIELDS[name]
            elif name in seen:
                expression += f"(?P={name})"
            else:
                expression += f"(?P<{name}>{FIELDS[name]})"
                seen.add(name)
        if re.sub(r"\{[^{}]*\}", "", text).strip("{}") != re.sub(r"\{[^{}]*\}", "", text):
            problems.append(f"--pattern {text}: has a brace without its other; write {{vehicle}}")
        if not seen and not problems:
            problems.append(
                f"--pattern {text}: names nothing; write {{vehicle}}, {{axle}}, {{side}}, {{date}}"
            )
        if problems:
            raise InputError(problems)
        self._expression = re.compile(rf"(?:.*/)?{expression}")

    def read(self, path: PurePath) -> dict[str, str] | None:
        """Give the columns of a manifest that a path states; ``None`` where it does not fit."""
        match = self._expression.fullmatch(path.as_posix())
        if match is None:
            return None
        return {{"date": "time"}.get(name, name): value for name, value in match.groupdict().items()}
