"""Write docs/evidence/santos2017.md and its pictures: ``python -m evidence.santos2017.page``.

This runs everything: half a minute with compiled kernels.
"""

from __future__ import annotations

from evidence.pages import PICTURES, REPORTS, render
from evidence.santos2017.comparison import SantosRuns, refusal, rows, run_all
from evidence.santos2017.pictures import DRAWINGS
from evidence.santos2017.spectrum import PUBLISHED_BAND, Bands

PAGE = REPORTS / "santos2017.md"


def spectrum_row(each: Bands, reference: Bands) -> tuple[str, ...]:
    """List the cells of one row of the table of bands."""
    bounce = [f"{value / 1e3:.1f}" for value in each.bounce]
    factors = sorted(one / two for one, two in zip(each.bounce, reference.bounce, strict=True))
    expected = " to ".join(dict.fromkeys(f"{factor:.2f}" for factor in factors))
    places, shift = " and ".join(f"{value / 1e3:.1f}" for value in each.found), each.shift_from(reference)
    return (
        each.variation.name,
        f"{each.step * 1e6:.2f}",
        *bounce,
        *((places, expected, f"{shift:.2f}") if each.level > 0.2 * reference.level else ("gone", "", "")),
        f"{each.level:.1f}",
    )


def page(runs: SantosRuns) -> str:
    """Put the whole page together."""
    plain, audit = runs.bands[0], runs.undamped.blocks[-1].audit
    assert audit is not None
    diameter = runs.step.scene.bearing.roller_diameter * plain.bounce[1] / PUBLISHED_BAND
    values = {
        "rows": [(row.quantity, row.published, row.ours, row.remark) for row in rows(runs)],
        "refusal": refusal(),
        "bands": [spectrum_row(each, plain) for each in runs.bands],
        "diameter": diameter * 1e3,
        "numerical": abs(audit.numerical) / audit.external,
    }
    return render(__file__, values)


def main() -> None:
    """Run, draw, write."""
    runs = run_all()
    for name, draw in DRAWINGS.items():
        draw(runs, PICTURES / name)
    PAGE.write_text(page(runs), encoding="utf-8")
    print(f"written: {PAGE}")


if __name__ == "__main__":
    main()
