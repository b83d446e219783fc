"""Write docs/santos2017.md and its pictures: ``python -m evidence.santos2017.page``.

This runs everything: half a minute with compiled kernels.
"""

from __future__ import annotations

from evidence.pages import DOCS, PICTURES
from evidence.santos2017.comparison import SantosRuns, refusal, rows, run_all
from evidence.santos2017.pictures import DRAWINGS
from evidence.santos2017.spectrum import PUBLISHED_BAND, Bands

PAGE = DOCS / "santos2017.md"

HEAD = """# The runs of Santos (2017)

What BearDyn of 2017 ran, run again: G. N. dos Santos, *Dynamics of Tapered Roller Bearings: Modelling and
Analysis*, summary of the thesis, Instituto Superior Técnico, Lisbon, November 2017. Sections, figures and
tables are those of the summary; the thesis itself was not read. The summary gives no dimensions of its
bearing, so ours is HS130x230, with six laminae like its six circles. This page is written by
`python -m evidence.santos2017.page` and tested by `evidence/santos2017`.

| quantity | Santos (2017) | ours | remark |
|---|---|---|---|
"""

STEP = """
## The load comes on

![Radial force after the load comes on](pictures/santos_step.png)

`beardyn simulate santos_step`: one dry row starts without load and is loaded with 5 kN. Its ring of 7 kg
rings on the rollers at 3 kHz; contact damping and friction use that up. Without the prop:

> {refusal}

## The band at 30 kHz

![Spectrum of the radial force](pictures/santos_spectrum.png)

A roller is a mass on its line contacts: $f = \\sqrt{{k/m}}/2\\pi$ with
$k = \\frac{{10}}{{9}} K^{{9/10}} Q^{{1/10}}$ of each contact, which hardly depends on its load. The loaded
row therefore rings in two bands: rollers that centrifugal force holds to the cup alone, and rollers between
both raceways, the heaviest loaded one at the upper end. Each run below takes 5 kN at once and differs in one
thing; the spectrum is that of the force from 0.01 s after the load on, as in its figure.
*Expected* is the factor between the computed frequencies, *found* the factor in frequency by which the whole
spectrum from 8 to 22 kHz has moved.

| change | step, µs | cup alone, kHz | both raceways, kHz | highest places, kHz | expected | found | rms, N |
|---|--:|--:|--:|--:|--:|--:|--:|
"""

VERDICT = """
- The bands are physics, not the time step: half and twice the step leave them where they are, lighter
  rollers move both by the root of the mass, stiffer contacts by the root of the stiffness (to the power 9/10,
  since the contact law is not linear). The time step itself takes {numerical:.1g} of the energy that the load
  puts in.
- A roller of this size bounces at 17 kHz, not 30. The frequency goes as one over its diameter and hardly with
  its length or load, so 30 kHz would be rollers of about {diameter:.0f} mm in diameter, small
  for an axlebox bearing.
- The same roller does ring at 33 kHz, with any step, when its contacts are $6^{{8/9}} = 4.92$ times as
  stiff. That is what its contact law (Section 5.1) gives when $L_{{ef}}$ is read as the length
  of the whole roller in each of six slices; with the length of a slice it is Palmgren's law. **Our
  answer: the band is the bounce of rollers between the raceways, which nothing damps in Section 5.1, and
  it is at 30 rather than 17 kHz most simply because of that length.** Not proven, for code and dimensions
  are not printed; and in ours the band of the rollers on the cup alone, then at 21 kHz, stands out more,
  of which the text says nothing.
- Two other causes cannot be excluded from the text: smaller rollers, and its sampling. The axis of Fig. 6(b)
  ends at 50 kHz, as with samples every 10 µs, and forces were kept at accepted steps of ODE45, which are not
  evenly spaced. But nothing in our runs lies at the 70 kHz that would fold back to 30.
- With contact damping of 5 µs, usual for lubricated steel, the bands are gone, as Section 7.1 expects of a
  healthy bearing (Li et al. 2000).

## Friction

![Tangential over normal force](pictures/santos_friction.png)

Dry contacts that slide are at 10 %, here as there. Raceways on which rollers roll are not, dry or lubricated.

## What could not be done as it was

- Dimensions, speed, temperature, end play, the mass of the inner ring and the axial force are not in the
  summary: ours are those of the scenes `santos_*`.
- Its bearing starts from nominal places, ours from the static equilibrium; the first peak of Fig. 6(a)
  cannot be compared.
- Its friction at zero slip is not described. Ours is smooth there.
- Its times are of another computer, in MATLAB, with another integrator; contact detection alone, method by
  method, is a matter for the contact laboratory.
"""


def spectrum_row(each: Bands, reference: Bands) -> str:
    """Write one row of the table of bands."""
    bounce = [f"{value / 1e3:.1f}" for value in each.bounce]
    factors = sorted(one / two for one, two in zip(each.bounce, reference.bounce, strict=True))
    expected = " to ".join(dict.fromkeys(f"{factor:.2f}" for factor in factors))
    places, shift = " and ".join(f"{value / 1e3:.1f}" for value in each.found), each.shift_from(reference)
    cells = (
        each.variation.name,
        f"{each.step * 1e6:.2f}",
        *bounce,
        *((places, expected, f"{shift:.2f}") if each.level > 0.2 * reference.level else ("gone", "", "")),
        f"{each.level:.1f}",
    )
    return f"| {' | '.join(cells)} |\n"


def page(runs: SantosRuns) -> str:
    """Put the whole page together."""
    plain = runs.bands[0]
    diameter = runs.step.scene.bearing.roller_diameter * plain.bounce[1] / PUBLISHED_BAND
    text = HEAD
    for row in rows(runs):
        text += f"| {row.quantity} | {row.published} | {row.ours} | {row.remark} |\n"
    text += STEP.format(refusal=refusal())
    text += "".join(spectrum_row(each, plain) for each in runs.bands)
    audit = runs.undamped.blocks[-1].audit
    assert audit is not None
    numerical = abs(audit.numerical) / audit.external
    return text + VERDICT.format(diameter=diameter * 1e3, numerical=numerical)


def main() -> None:
    """Run, draw, write."""
    runs = run_all()
    for name, draw in DRAWINGS.items():
        draw(runs, PICTURES / name)
    PAGE.write_text(page(runs), encoding="utf-8")
    print(f"written: {PAGE}")


if __name__ == "__main__":
    main()
