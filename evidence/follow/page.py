"""Write what the demonstration showed into docs/evidence/estimator.md: ``python -m evidence.follow.page``."""

from __future__ import annotations

import beardyn_core as bd
from evidence.follow.demo import BESIDE, draw, played, table
from evidence.pages import PICTURES, REPORTS, replace_between, save_small

PAGE, PICTURE = REPORTS / "estimator.md", PICTURES / "follow.png"
BEFORE, AFTER = "ended with\n\n```text\n", "\n```\n\nand draws this"
COLOURS = 64


def with_table(page: str, written: str) -> str:
    """Put a table of truth and estimates in the place of that of the page."""
    return replace_between(page, BEFORE, AFTER, written)


def main() -> None:
    """Play, follow and write."""
    found = bd.follow(played(), twin=BESIDE)
    text = table(found)
    print(text)
    draw(found, PICTURE)
    save_small(PICTURE, PICTURE, COLOURS)
    PAGE.write_text(with_table(PAGE.read_text(encoding="utf-8"), text), encoding="utf-8")


if __name__ == "__main__":
    main()
