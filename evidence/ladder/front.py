"""Accuracy over cost for README.md, from docs/evidence/ladder.md: ``python -m evidence.ladder.front``."""

from __future__ import annotations

import re
from pathlib import Path

from evidence.pages import DOCS, REPORTS, replace_between

README = DOCS.parent / "README.md"
SCENE = "service_high_speed"
BEGIN, END = "<!-- evidence.ladder.front -->\n", "<!-- end of evidence.ladder.front -->\n"
_ROW = re.compile(rf"^\| {SCENE} \| (.+)$", re.MULTILINE)
_MACHINE = re.compile(r"on one core of\n(.+?) \(", re.DOTALL)


def front(ladder: str) -> str:
    """Write the efficient levels of one scene.

    Parameters
    ----------
    ladder : str
        The page of the ladder.
    """
    machine = _MACHINE.search(ladder)
    assert machine is not None
    rows = [f"| {row}" for row in _ROW.findall(ladder)]
    return "\n".join(
        [
            f"What accuracy costs in [`{SCENE}`](docs/evidence/ladder.md), a healthy bearing at 200 km/h "
            f"in a box that rings, on one core of {machine[1]}. Errors are against tier `full` with all "
            "effects, 40 slices (laminae) and 8 time steps per sample. *6 laminae x 3*: 6 slices, 3 steps "
            "per sample of 25.6 kHz. Rows without a tier are `full`. Brackets: within the scatter of two "
            "equal runs. *5 %*: force, deflection, roller load and torque within 5 %, third octaves "
            "within 1.5 dB, all uncertainty included. `standard` has rigid rings and a rigid box.",
            "",
            "| tier, effects | s of a core for 1 s | force % | deflection % | roller load % | torque % "
            "| vibration dB | 5 % |",
            "|---|--:|--:|--:|--:|--:|--:|---|",
            *rows,
            "",
        ]
    )


def renewed(readme: str, ladder: str) -> str:
    """Put the front of a page of the ladder into the text of README.md."""
    return replace_between(readme, BEGIN, END, f"\n{front(ladder)}\n")


def main(ladder: Path = REPORTS / "ladder.md") -> None:
    """Renew README.md."""
    text = renewed(README.read_text(encoding="utf-8"), ladder.read_text(encoding="utf-8"))
    README.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
