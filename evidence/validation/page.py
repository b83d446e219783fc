"""Write docs/evidence/validation.md and its pictures: ``make validation``.

Runs every anchor and every trend, the dynamic ones too: a quarter of an hour, the first time also compiling.
With topics as arguments it works out the numbers, trends and pictures of these alone and leaves the rest of
the page as it is.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

from evidence.pages import PICTURES, REPORTS, write_page
from evidence.stamps import stamp
from evidence.tables import joined_rows
from evidence.validation.anchor import HOLDS_FROM, Anchor, Finding, Trend
from evidence.validation.every import ANCHORS, TRENDS, UNREACHED
from evidence.validation.pictures import DRAWINGS

PAGE = REPORTS / "validation.md"

COUNTED = [anchor for anchor in ANCHORS if not anchor.beside]
OTHERS = "## Formulas that the simulator does not use"


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


def values_of(
    numbers: Sequence[str], trends: Sequence[str], held: int, others: Sequence[str]
) -> dict[str, Any]:
    """Give the numbers of the page: rows that count, paragraphs of trends, and rows that do not count."""
    agree = ["**misses**" not in each for each in numbers]
    measured = [right for anchor, right in zip(COUNTED, agree, strict=True) if anchor.measured]
    return {
        "agree": sum(agree),
        "count": len(agree),
        "held": held,
        "trend_count": len(TRENDS),
        "measured": len(measured),
        "measured_agree": sum(measured),
        "numbers": numbers,
        "least": 100.0 * HOLDS_FROM,
        "trends": trends,
        "others": others,
        "unreached": [unreached_line(label, why) for label, why in UNREACHED],
    }


def unreached_line(label: str, why: str) -> str:
    """Write one entry of what is not compared."""
    return f"- {label}: {why}."


def row(anchor: Anchor) -> str:
    """Write one row of the table."""
    ours = anchor.ours()
    off = (
        f"{100.0 * (ours / anchor.reference - 1.0):+.2f} %"
        if anchor.reference
        else f"{ours - anchor.reference:+.3g} {anchor.unit}".strip()
    )
    verdict = "agrees" if anchor.agrees(ours) else f"**misses**: {anchor.misses or 'not explained'}"
    cells = (
        *reference_cells(anchor),
        f"{number(ours)} {anchor.unit}".strip(),
        off,
        allowed(anchor),
        verdict,
        anchor.source,
    )
    return joined_rows([cells])


def trend_heading(trend: Trend) -> str:
    """Write the heading of one trend."""
    return f"### {trend.topic}: {trend.claim}"


def trend_lines(trend: Trend, finding: Finding) -> list[str]:
    """Write the paragraph of one trend."""
    verdict = "holds" if finding.holds else f"**does not hold**: {trend.misses or 'not explained'}"
    lines = [trend_heading(trend), "", f"{finding.sentence} Verdict: {verdict}.", ""]
    lines += [f"Source: {trend.source}.", ""]
    if trend.picture:
        lines += [f"![{trend.claim}](../pictures/{trend.picture})", ""]
    return lines


def rewrite(topics: list[str]) -> None:
    """Write the rows and trends of some topics anew; all others stay as they are."""
    lines = PAGE.read_text(encoding="utf-8").splitlines()
    begin, middle, end = lines.index("## Numbers"), lines.index("## Trends"), lines.index(OTHERS)
    rows = []
    for anchor in COUNTED:
        start = "| " + " | ".join(reference_cells(anchor)) + " | "
        kept = [line for line in lines[begin:middle] if line.startswith(start)]
        rows.append(row(anchor) if anchor.topic in topics or not kept else kept[0])
        if anchor.topic in topics:
            print(rows[-1], flush=True)
    trends, held = trends_anew(lines[middle:end], topics)
    others = [line for line in lines[end:] if line.startswith("| ")][1:]
    write_page(__file__, PAGE, values_of(rows, trends, held, others))
    for name in {trend.picture for trend in TRENDS if trend.topic in topics and trend.picture}:
        DRAWINGS[name](PICTURES / name)
        stamp(PICTURES / name)


def trends_anew(known: list[str], topics: list[str]) -> tuple[list[str], int]:
    """Write the paragraphs of the trends, those of some topics anew, and count those that hold."""
    written, held = list[str](), 0
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
    rows = {}
    for anchor in ANCHORS:
        rows[anchor] = row(anchor)
        print(rows[anchor], flush=True)
    trends, held = trends_anew([], [])
    for name, draw in DRAWINGS.items():
        draw(PICTURES / name)
        stamp(PICTURES / name)
    others = [rows[anchor] for anchor in ANCHORS if anchor.beside]
    write_page(__file__, PAGE, values_of([rows[anchor] for anchor in COUNTED], trends, held, others))


if __name__ == "__main__":
    main()
