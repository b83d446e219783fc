"""Write docs/validation.md and its pictures: ``python -m evidence.validation.page`` (`make validation`).

Runs every anchor and every trend, the dynamic ones too: a quarter of an hour, the first time also compiling.
With topics as arguments it works out the numbers, trends and pictures of these alone and leaves the rest of
the page as it is.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Sequence

from evidence.pages import DOCS, PICTURES
from evidence.stamps import stamp
from evidence.validation.anchor import HOLDS_FROM, Anchor, Finding, Trend
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

COUNTED = [anchor for anchor in ANCHORS if not anchor.beside]
UNREACHED_HEAD = "## Not compared"
OTHERS = "## Formulas that the simulator does not use"
TRENDS_HEAD = (
    "",
    "## Trends",
    "",
    f"Of every rise, fall and difference {100.0 * HOLDS_FROM:g} % counts as none: a quantity rises where it "
    "ends by more than that\nabove where it began and no step goes back by as much. A trend that does not "
    "hold stands with the cause that was\ntested, in a run beside it that removes the cause, or says that "
    "none was found.",
    "",
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


def totals(agree: Sequence[bool], held: int) -> str:
    """Count what agrees of all rows that count, of the measured ones among them, and of the trends."""
    measured = [right for anchor, right in zip(COUNTED, agree, strict=True) if anchor.measured]
    return (
        f"{sum(agree)} of {len(agree)} numbers agree within their tolerance; "
        f"{held} of {len(TRENDS)} published trends are reproduced.\nOf the numbers {len(measured)} were "
        f"measured; {sum(measured)} of these agree. The others are formulas, catalogue values and other "
        "models.\n\n"
    )


def unreached_lines() -> list[str]:
    """Write the section of what is not compared."""
    return [UNREACHED_HEAD, "", *(unreached_line(label, why) for label, why in UNREACHED)]


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


def trend_heading(trend: Trend) -> str:
    """Write the heading of one trend."""
    return f"### {trend.topic}: {trend.claim}"


def trend_lines(trend: Trend, finding: Finding) -> list[str]:
    """Write the paragraph of one trend."""
    verdict = "holds" if finding.holds else f"**does not hold**: {trend.misses or 'not explained'}"
    lines = [trend_heading(trend), "", f"{finding.sentence} Verdict: {verdict}.", ""]
    lines += [f"Source: {trend.source}.", ""]
    if trend.picture:
        lines += [f"![{trend.claim}](pictures/{trend.picture})", ""]
    return lines


def rewrite(topics: list[str]) -> None:
    """Write the rows and trends of some topics anew; all others stay as they are."""
    lines = PAGE.read_text(encoding="utf-8").splitlines()
    begin, end, after = lines.index(TABLE[1]) + 1, lines.index("## Trends") - 1, lines.index(OTHERS)
    known = lines[begin:end]
    rows = []
    for anchor in COUNTED:
        start = "| " + " | ".join(reference_cells(anchor)) + " | "
        kept = [line for line in known if line.startswith(start)]
        rows.append(row(anchor)[0] if anchor.topic in topics or not kept else kept[0])
        if anchor.topic in topics:
            print(rows[-1], flush=True)
    trends, held = trends_anew(lines[end:after], topics)
    others = lines[after : lines.index(UNREACHED_HEAD)]
    text = "\n".join([*lines[:begin], *rows, *trends, *others, *unreached_lines()]) + "\n"
    told = totals(["**misses**" not in each for each in rows], held)
    PAGE.write_text(re.sub(r"^\d+ of \d+ numbers agree[^#]*\n\n", told, text, flags=re.M), encoding="utf-8")
    for name in {trend.picture for trend in TRENDS if trend.topic in topics and trend.picture}:
        DRAWINGS[name](PICTURES / name)
        stamp(PICTURES / name)


def trends_anew(known: list[str], topics: list[str]) -> tuple[list[str], int]:
    """Write the section of the trends, those of some topics anew, and count those that hold."""
    written, held = list(TRENDS_HEAD), 0
    for trend in TRENDS:
        heading = trend_heading(trend)
        if trend.topic in topics or heading not in known:
            paragraph = trend_lines(trend, trend.study())
            print(*paragraph[:3], sep="\n", flush=True)
        else:
            start = known.index(heading)
            stop = next((at for at in range(start + 1, len(known)) if known[at][:4] == "### "), len(known))
            paragraph = known[start:stop]
        held += paragraph[2].endswith("Verdict: holds.")
        written += paragraph
    return written, held


def main() -> None:
    """Run everything and write the page."""
    if len(sys.argv) > 1:
        rewrite(sys.argv[1:])
        return
    rows = {anchor: row(anchor) for anchor in ANCHORS}
    for text, _ in rows.values():
        print(text, flush=True)
    lines = [*TABLE, *(rows[anchor][0] for anchor in COUNTED)]
    others = [OTHERS, "", BESIDE, "", *TABLE]
    others += [rows[anchor][0] for anchor in ANCHORS if anchor.beside]
    trends = list(TRENDS_HEAD)
    held = 0
    for trend in TRENDS:
        finding = trend.study()
        held += finding.holds
        trends += trend_lines(trend, finding)
        print(trend.topic, finding.holds, finding.sentence, flush=True)
    for name, draw in DRAWINGS.items():
        draw(PICTURES / name)
        stamp(PICTURES / name)
    told = totals([rows[anchor][1] for anchor in COUNTED], held) + "## Numbers\n\n"
    PAGE.write_text(
        HEAD + told + "\n".join([*lines, *trends, *others, "", *unreached_lines()]) + "\n", encoding="utf-8"
    )


if __name__ == "__main__":
    main()
