"""Write docs/validation.md and its pictures: ``python -m evidence.validation.page`` (`make validation`).

Runs every anchor and every trend, the dynamic ones too: a few minutes, the first time also compiling. With
topics as arguments it works out the numbers of these alone and leaves the rest of the page as it is.
"""

from __future__ import annotations

import re
import sys

from evidence.pages import DOCS, PICTURES
from evidence.validation.anchor import Anchor, Finding, Trend
from evidence.validation.every import ANCHORS, TRENDS, UNREACHED
from evidence.validation.pictures import DRAWINGS

PAGE = DOCS / "validation.md"

HEAD = """# Validation

Published numbers and trends beside ours. This page is written by `make validation`; every row is also a test
(`evidence/validation`), and a row that misses says why. *Derived*: computed apart from this code when the
reference data were collected, not measured; *from memory*: the source was not at hand. Deviations are
relative where the reference is not zero. A row counts where the simulator itself produces the number.

"""
TABLE = (
    "| topic | quantity | reference | ours | deviation | allowed | verdict | source |",
    "|---|---|---|---|---|---|---|---|",
)
BESIDE = (
    "Published formulas and cases for other bearings, worked out beside the simulator, as references of its "
    "own\nlaws; and lateral levels of axleboxes in the rail model, which the twin's sensor reads in part. "
    "They are not counted above."
)


def number(value: float) -> str:
    """Write a number with about five significant digits."""
    text = f"{value:.5g}"
    return f"{value:,.0f}" if abs(value) >= 1e4 and value == round(value) else text


def allowed(anchor: Anchor) -> str:
    """Write the tolerance of a row."""
    parts = [f"{100.0 * anchor.tolerance:g} %"] if anchor.tolerance else []
    parts += [f"{anchor.absolute:g} {anchor.unit}".strip()] if anchor.absolute else []
    return " + ".join(parts) or "exact"


def reference_cells(anchor: Anchor) -> tuple[str, str, str]:
    """List the cells of a row that need no computing."""
    return anchor.topic, anchor.quantity, f"{number(anchor.reference)} {anchor.unit}".strip()


def unreached_line(label: str, why: str) -> str:
    """Write one entry of what is not compared."""
    return f"- {label}: {why}."


def row(anchor: Anchor) -> tuple[str, bool]:
    """Write one row of the table, and say whether ours agrees."""
    ours = anchor.ours()
    agrees = anchor.agrees(ours)
    off = (
        f"{100.0 * (ours / anchor.reference - 1.0):+.2f} %"
        if anchor.reference
        else f"{ours - anchor.reference:+.3g} {anchor.unit}".strip()
    )
    verdict = "agrees" if agrees else f"**misses**: {anchor.misses or 'not explained'}"
    cells = (
        *reference_cells(anchor),
        f"{number(ours)} {anchor.unit}".strip(),
        off,
        allowed(anchor),
        verdict,
        anchor.source,
    )
    return "| " + " | ".join(cells) + " |", agrees


def trend_lines(trend: Trend, finding: Finding) -> list[str]:
    """Write the paragraph of one trend."""
    verdict = "holds" if finding.holds else f"**does not hold**: {trend.misses or 'not explained'}"
    lines = [f"### {trend.topic}: {trend.claim}", "", f"{finding.sentence} Verdict: {verdict}.", ""]
    lines += [f"Source: {trend.source}.", ""]
    if trend.picture:
        lines += [f"![{trend.claim}](pictures/{trend.picture})", ""]
    return lines


def rewrite(topics: list[str]) -> None:
    """Write the rows of some topics anew; all other rows, and the trends, stay as they are."""
    lines = PAGE.read_text(encoding="utf-8").splitlines()
    begin, end = lines.index(TABLE[1]) + 1, lines.index("## Trends") - 1
    known = lines[begin:end]
    rows = []
    for anchor in ANCHORS:
        if anchor.beside:
            continue
        start = "| " + " | ".join(reference_cells(anchor)) + " | "
        kept = [line for line in known if line.startswith(start)]
        rows.append(row(anchor)[0] if anchor.topic in topics or not kept else kept[0])
        if anchor.topic in topics:
            print(rows[-1], flush=True)
    good = sum("**misses**" not in each for each in rows)
    text = "\n".join([*lines[:begin], *rows, *lines[end:]]) + "\n"
    counted = r"^\d+ of \d+ numbers"
    PAGE.write_text(re.sub(counted, f"{good} of {len(rows)} numbers", text, flags=re.M), encoding="utf-8")


def main() -> None:
    """Run everything and write the page."""
    if len(sys.argv) > 1:
        rewrite(sys.argv[1:])
        return
    rows = {anchor: row(anchor) for anchor in ANCHORS}
    for text, _ in rows.values():
        print(text, flush=True)
    counted = [anchor for anchor in ANCHORS if not anchor.beside]
    lines = [*TABLE, *(rows[anchor][0] for anchor in counted)]
    others = ["## Formulas that the simulator does not use", "", BESIDE, "", *TABLE]
    others += [rows[anchor][0] for anchor in ANCHORS if anchor.beside]
    trends = ["", "## Trends", ""]
    held = 0
    for trend in TRENDS:
        finding = trend.study()
        held += finding.holds
        trends += trend_lines(trend, finding)
        print(trend.topic, finding.holds, finding.sentence, flush=True)
    for name, draw in DRAWINGS.items():
        draw(PICTURES / name)
    unreached = ["## Not compared", ""]
    unreached += [unreached_line(label, why) for label, why in UNREACHED]
    good = sum(rows[anchor][1] for anchor in counted)
    total = (
        f"{good} of {len(counted)} numbers agree within their tolerance; "
        f"{held} of {len(TRENDS)} published trends are reproduced.\n\n## Numbers\n\n"
    )
    PAGE.write_text(
        HEAD + total + "\n".join([*lines, *trends, *others, "", *unreached]) + "\n", encoding="utf-8"
    )


if __name__ == "__main__":
    main()
