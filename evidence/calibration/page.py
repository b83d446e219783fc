"""Write truth beside fit of hidden axleboxes into docs/estimate.md: ``python -m evidence.calibration.page``.

``-o FOLDER`` keeps recordings, scenes and results; what is there is not done again.
"""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path
from typing import Any

from evidence.calibration.hidden import BOXES, Hidden, found_of, rows
from evidence.pages import DOCS, render, replace_between

PAGE = DOCS / "estimate.md"
BEGIN, END = "<!-- evidence.calibration.page -->\n", "<!-- end of evidence.calibration.page -->\n"


def table(results: dict[Hidden, dict[str, Any]]) -> str:
    """Write the tables."""
    told = [(box, each) for box, found in results.items() for each in found["unknowns"]]
    fitted = [(box, each) for box, each in told if not each["reason"]]
    inside = sum(e["interval_90"][0] <= getattr(box, e["name"]) <= e["interval_90"][1] for box, e in fitted)
    values = {
        "numbers": [line for box, found in results.items() for line in rows(box, found)],
        "residuals": [
            (
                box.name,
                f"{found['residual_before_dB']:.1f} dB",
                f"{found['residual_after_dB']:.1f} dB",
                found["twins"],
            )
            for box, found in results.items()
        ],
        "fitted": len(fitted),
        "inside": inside,
        "left": len(told) - len(fitted),
    }
    return render(__file__, values)


def with_table(page: str, text: str) -> str:
    """Put tables in the place of those of the page."""
    return replace_between(page, BEGIN, END, f"\n{text}\n")


def main(argv: list[str] | None = None) -> int:
    """Play, calibrate and write."""
    parser = argparse.ArgumentParser(prog="python -m evidence.calibration.page", description=__doc__)
    parser.add_argument("-o", "--output", type=Path, help="folder that keeps what is done; default none")
    parser.add_argument(
        "--box", choices=[each.name for each in BOXES], help="this one alone, without the page"
    )
    args = parser.parse_args(argv)
    with tempfile.TemporaryDirectory() as scratch:
        folder = args.output or Path(scratch)
        folder.mkdir(exist_ok=True)
        chosen = [each for each in BOXES if args.box in (None, each.name)]
        text = table({box: found_of(box, folder) for box in chosen})
    print(text)
    if args.box is None:
        PAGE.write_text(with_table(PAGE.read_text(encoding="utf-8"), text), encoding="utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
