"""Write docs/trial.md from the trial.json of trials: ``python -m evidence.trial.page FOLDER [FOLDER ...]``.

Folders are those of ``beardyn trial -o FOLDER``. That of `default` makes the page and its picture; of others
there are sections in it, which stay as they were when their folders are not given.
"""

from __future__ import annotations

import argparse
import json
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from beardyn_core.monitor.chain import MonitorSettings
from evidence.pages import DOCS, PICTURES, save_small
from evidence.trial.rivals import EVERY, Judged, orders, table

PAGE = DOCS / "trial.md"
PICTURE = PICTURES / "trial.png"
COLOURS = 64
DEFAULT = "default"
NEXT = "## The monitor\n"
# of another trial, or of other monitors
_SECTION = re.compile(
    r"^## (?:`\w+`|Beside other monitors|With the effects `standard`)\n(?:(?!## ).*\n)*", re.MULTILINE
)
EXAMPLE = DOCS / "examples" / "my_monitor.py"

ABOUT = """
## The monitor

Six plain functions, put together by `beardyn_core.monitor.chain.Chain`:

| step | ours | what it does |
|---|---|---|
| `select_band` | `whitening.whole_band` | 500 Hz to 12 kHz, or to 0.45 of the rate |
| `whiten` | `whitening.by_cepstrum` | every frequency gets the same weight |
| `envelope` | `chain.squared_envelope` | squared envelope, all axes added |
| `track` | `tracking.logarithm_by_angle` | its logarithm by shaft angle, less what the wheel does |
| `score` | `fault_lines.comb_score` | power on the lines of each part, over noise |
| `decide` | `verdict.strongest_pattern` | the part with most evidence, if no rival has more; a hot box |

Cepstrum pre-whitening leaves the phase alone (Borghesani and others 2013); `kurtogram.by_kurtogram`, the
1/3-binary tree of Antoni (2007), is there as another `select_band`. Order tracking takes out the mean over
the revolutions at each angle of the wheel, which holds every whole order, and leaves out the sectors in
which the wheel strikes in three of four revolutions: flats and polygons. A score adds five harmonics of
BPFO, or of BPFI or 2 BSF with a sideband on both sides, less the strongest line. Evidence is how seldom
noise has such a sum anywhere. A part is not called when a rival has more: a comb of five harmonics of any
order that the part's lines and sidebands do not explain, the same comb with the sidebands of another part,
or a part at another speed. A comb that strikes and fits no part is `unexplained`
([when speed or bearing may be wrong](measured.md#when-speed-or-bearing-may-be-wrong)). Lines that belong to
a part with more evidence are no strikes of another. What strikes like clockwork is tones, which whitening
takes away; where nothing else is found and lines make {clockwork:g} of the power, it is sought as
measured, and must strike with {deep:g} of it. [monitor_measured.md](monitor_measured.md) has what the chain
says of measured bearings.

The formula of BSF is that of the mean diameters, with the common apex of a tapered bearing exactly the
speed of pure rolling. In `roller_spall` spin against cage over BSF is 1.000 in the fast tiers. In the
full one it is 1.000 on average above 2 kN of load, and 0.997 over whole turns of the cage, because drag
slows unloaded rollers. The line of the squared envelope lies within 0.1 % of twice the mean spin. One
analysis knows a line only to its resolution, one over the revolutions: 0.064 orders or 0.95 % of 2 BSF in
the first one, of 15.5 revolutions, and 0.25 % over 60.

**The threshold is not tuned on this matrix.** In stationary noise the lines of a squared-envelope spectrum
are independent and exponentially distributed over their local mean; the sum of L of them less the largest has
a known tail (Renyi's representation, saddle point of Lugannani and Rice). The threshold is where that tail,
times the number of independent places searched and the three parts, comes to {rate:g} an analysis. What a
bearing, track and wheel do beyond stationary noise is what the trial shows. The chain before it was
not blind to this twin: what counts as a strike of the wheel (`wheel.py`), which whole orders are left out,
how sidebands count, the limits of the band and when a part is not called were set by eye on its runs, some
of them of `quick`; `default` has other speeds and seeds, but no other twin.

Sure is not enough: a sound bearing has lines of its own, of rollers that enter the load zone and of waves
that they pass again and again, and under a quiet sensor they are no chance. They are smooth, so that one
harmonic holds most of them; a spall gives short strikes, which have many. A pattern is called only when its
harmonics but the loudest, of {harmonics}, make {whole:g} of the mean power in the signal as measured, beside
the strikes of the wheel, or in one octave (1.6, 3.2 or 6.4 kHz and up) {cup:g} on
the cup, with which sound rollers pass, too, and {others:g} on cone and rollers. The bounds were set on
measured records ([monitor_measured.md](monitor_measured.md)) and on sound runs of the twin.
`beardyn trial healthy` runs 30 sound bearings with a sensor noise of 3e-4 m/s²/√Hz in two tiers and tells
every alarm with part, frequency and band.

The temperature rule calls a hot box from {hot:.0f} °C on, or from {heating:g} K a minute
above {floor:.0f} °C.
EN 15437-2 leaves such levels to the vehicle; these are assumed.

Replace one function with yours:

```python
{example}```

```bash
beardyn trial quick --monitor my_monitor:chain      # from the folder of my_monitor.py
beardyn monitor run.mcap --monitor my_monitor:chain # over a recording
ros2 run beardyn monitor --ros-args -p algorithm:=my_monitor:chain
```
"""

LIMITS = """
## What it does not say

- **Other matrices**: `healthy_500` has 504 sound bearings under three kinds of sensors, `shapes` spalls that
  are slots, whole contacts, round and irregular, `cage` worn pockets, which no verdict names. A monitor that
  fails costs its run and no other: the sentence with file and line stands in the result.
- **The spalls are round numbers**: a rectangular pit with sharp edges, twice as long as wide, a tenth as deep
  as wide, at most 100 µm; on the cup within 30 degrees of the middle of the load zone. Of other shapes
  most are not found: of round and irregular ones up to 8 mm three of 108, of slots half, by `shapes` above.
- **The background is that of `driven_emu`** on an even track: roughness, drive, other bearing, knocks and
  pickup, most of their levels assumed ([sensors.md](sensors.md) has what each adds), behind a sensor by data
  sheet. The modes of the box are those of a class of box, damped by 2 % by assumption.
- **The tier `quasistatic`** finds some spalls of middling size that `full` hides, and the other way round:
  the check says by how much scores and verdicts differ. [ladder.md](ladder.md) has the errors of the tiers.
- **A worn pocket is heard, late, but cannot be named.** Its roller passes the load zone behind its place by
  half of the wear, and once a turn of the cage it is louder: lines of FTF.
  `python -m evidence.trial.worn_pockets` lays eight of them over the chain's spectrum, of three bearings at
  160 km/h, each sound, worn by 0.5, 1 and 2 mm, and sound but of grade G3. They pass an alarm set as for the
  other parts over the 40 revolutions of a run of `cage` in 1 of 9 worn bearings, over the 60 of the monitor's
  window in 4, over 120 in 6: all with 1 and 2 mm, none with 0.5 mm. None of 6 sound ones passes it. But the
  cage is in whatever else comes and goes with the rollers: of measured bearings without a faulty cage (the
  same with `--cwru` and `--mfpt`, over 60 revolutions) 16 of 63 with a faulty cup, 2 of 37 with a faulty cone
  and 10 of 31 with a faulty roller have such lines, of 111 sound ones none. They say that something is wrong
  and not what, so there is no verdict `cage`: one accelerometer does not diagnose it.
- **A flat can hide a spall on the cone**, also a large one: the sectors in which the wheel strikes and rings
  are left out, and with them the cone's part of the load zone.
- **Wide spalls of the cone** were taken for the wheel once, in 10 of 36 of 12 mm: rollers are in one for 0.41
  of the way to the next, nothing is quiet in the load zone, and 19 and 22 of 64 sectors counted as strikes of
  a round wheel at 160 and 250 km/h. Strikes must come at once now;
  `python -m evidence.trial.wide_spalls` has no sector left out and names the cone in all four runs.
  Flats keep the sectors they had.
"""


def main() -> None:
    """Write the page, or with folders of other trials than `default` their sections alone."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, nargs="+", help="of `beardyn trial -o`, that of `default` first")
    parser.add_argument(
        "--rivals", type=Path, help="of `python -m evidence.trial.rivals -o`; default as it was"
    )
    parser.add_argument(
        "--standard", type=Path, help="of the last one with `--effects standard`; default as it was"
    )
    args = parser.parse_args()
    folders = args.folder
    found = [json.loads((each / "trial.json").read_text(encoding="utf-8")) for each in folders]
    rivals = [] if args.rivals is None else json.loads(args.rivals.read_text(encoding="utf-8"))
    heard = "\n".join(_rivals([Judged(**each) for each in rivals]))
    beside = ""
    if args.standard is not None:
        standard = json.loads((args.standard / "trial.json").read_text(encoding="utf-8"))
        beside = "\n".join(beside_standard(found[-1], standard))
    text = PAGE.read_text(encoding="utf-8") if PAGE.exists() else ""
    if found[0]["trial"] == DEFAULT:
        text = with_old_sections(page(found[0]), text)
        save_small(folders[0] / "trial.png", PICTURE, COLOURS)
    others = [each for each in found if each["trial"] != DEFAULT]
    for section in (heard, *("\n".join(_in_short(each)) for each in others), beside):
        text = with_section_of(text, section)
    PAGE.write_text(text, encoding="utf-8")


def with_old_sections(page: str, old: str) -> str:
    """Take over what another page has of other trials and monitors."""
    for section in _SECTION.findall(old):
        page = with_section_of(page, section)
    return page


def with_section_of(page: str, section: str) -> str:
    """Put a section in the place of that of its title, or behind those of the other trials."""
    written = section.strip()
    if not written:
        return page
    title = written.partition("\n")[0] + "\n"
    start = page.find(title)
    begin = page.index(NEXT) if start < 0 else start
    end = begin if start < 0 else page.index("\n## ", start) + 1
    return page[:begin] + written + "\n\n" + page[end:]


def page(found: dict[str, Any]) -> str:
    """Write the page of a trial's JSON object."""
    settings = MonitorSettings()
    about = ABOUT.format(
        rate=settings.false_alarm_rate,
        harmonics=settings.strike_harmonics,
        whole=settings.least_strikes,
        cup=settings.least_sharpest[0],
        others=settings.least_sharpest[1],
        clockwork=settings.clockwork_depth,
        deep=settings.clockwork_strikes,
        hot=settings.hot - 273.15,
        heating=60.0 * settings.heating,
        floor=settings.heating_floor - 273.15,
        example=EXAMPLE.read_text(encoding="utf-8"),
    )
    lines = [
        "# The monitor on trial",
        "",
        f"Written by `python -m evidence.trial.page FOLDER` from `beardyn trial {found['trial']} -o FOLDER`: "
        f"{found['run_count']} runs of {found['revolutions']:g} shaft revolutions in the tier "
        f"`{found['tier']}`, seed {found['seed']}. Brackets are exact 95 % intervals (Clopper and Pearson).",
        "",
        f"{found['purpose']} The matrix is [config/trials/{found['trial']}.yaml]"
        f"(../config/trials/{found['trial']}.yaml); `beardyn trial MATRIX.yaml -o FOLDER` runs one of your "
        "own, keeps every run as it ends and goes on where it was stopped. A folder of another matrix or "
        "monitor is refused, `--force` starts it over. A run is done again when its scene, the simulator, or "
        "any module that the monitor imports has changed; data that a monitor reads from other files is not "
        "noticed.",
        "",
        "![Detection rate over size, and scores](pictures/trial.png)",
        "",
        "## What it finds",
        "",
        *_sizes(found),
        "## Where, and false alarms",
        "",
        "A run counts as found when most of its analyses name the part; a healthy run is a false alarm when "
        "a single one of them calls a fault.",
        "",
        *_slices(found),
        _analyses(found),
        *_check(found),
        *_invalid(found),
    ]
    return "\n".join(lines) + "\n" + about + LIMITS


def _in_short(found: dict[str, Any]) -> list[str]:
    """List what another trial found."""
    return [
        "",
        f"## `{found['trial']}`",
        "",
        f"{found['purpose']} {found['run_count']} runs, `{found['tier']}`, "
        f"[config/trials/{found['trial']}.yaml](../config/trials/{found['trial']}.yaml).",
        "",
        *_sizes(found),
        *_slices(found),
        _analyses(found),
        *_invalid(found),
    ]


def beside_standard(right: dict[str, Any], standard: dict[str, Any]) -> list[str]:
    """List what a trial found with the effects that its accuracy needs, and with `standard`."""
    if (one := right["trial"]) != (other := standard["trial"]):
        raise SystemExit(f"--standard is of the trial {other}; the last folder is of {one}")
    rows = zip(right["slices"], standard["slices"], strict=True)
    return [
        "",
        "## With the effects `standard`",
        "",
        f"The runs of `{one}` with the effects that `auto` takes, and with `--effects standard` (`beardyn "
        f"trial {one} -o A`, the same with `--effects standard -o B`, `python -m evidence.trial.page DEFAULT "
        "A --standard B`), which leave out rolling resistance and seals (coupled laminae no fast tier has). "
        "The box that rings, background, sensors and the bearings of the lot are those of the scene and "
        "stay: what the monitor finds is decided by them.",
        "",
        "| | found, `auto` | found, `standard` | false alarms, `auto` | false alarms, `standard` |",
        "|---|--:|--:|--:|--:|",
        *(
            f"| {a['name']} | {_rate(a['found'])} | {_rate(b['found'])} | {_rate(a['false_alarms'])} | "
            f"{_rate(b['false_alarms'])} |"
            for a, b in rows
        ),
    ]


def _rivals(judged: Sequence[Judged]) -> list[str]:
    if not judged:
        return []
    return [
        "",
        "## Beside other monitors",
        "",
        f"Every {EVERY}th run of `default`, simulated once and heard by the monitors of "
        "[monitor_measured.md](monitor_measured.md) (`python -m evidence.trial.rivals`): *ours*, a plain "
        "*envelope* spectrum, and the same after cepstrum pre-whitening (*CPW*), both without contradiction "
        "and bound.",
        "",
        table(judged),
        "",
        f"{orders(judged)} Measured records rank them in these orders, too: sound bearings beside faulty "
        "ones alarm least under ours and most under the envelope, which misses least.",
    ]


def _sizes(found: dict[str, Any]) -> list[str]:
    if not found["sizes"]:
        return []
    return [
        "| spall on | width mm | found and named right | another part named | score dB, median (range) |",
        "|---|--:|---|--:|---|",
        *(_size_row(row) for row in found["sizes"]),
        "",
        "Smallest width found in 90 % of the runs and at every larger one:",
        "",
        *(f"- {_smallest(row)}" for row in found["smallest"]),
        "",
    ]


def _slices(found: dict[str, Any]) -> list[str]:
    return [
        "| | found | healthy runs with a false alarm |",
        "|---|---|---|",
        *(
            f"| {row['name']} | {_rate(row['found'])} | {_rate(row['false_alarms'])} |"
            for row in found["slices"]
        ),
        "",
    ]


def _rate(rate: dict[str, Any]) -> str:
    if not rate["total"]:
        return "-"
    return (
        f"{rate['count']}/{rate['total']}, {100 * rate['rate']:.3g} % "
        f"({100 * rate['low']:.2g} to {100 * rate['high']:.3g})"
    )


def _size_row(row: dict[str, Any]) -> str:
    low, middle, high = row["score_dB"].values()
    score = "-" if middle is None else f"{middle:.1f} ({low:.1f} to {high:.1f})"
    return f"| {row['fault']} | {1e3 * row['width_m']:g} | {_rate(row['found'])} | {row['wrong']} | {score} |"


def _smallest(row: dict[str, Any]) -> str:
    if row["width_m"] is None:
        return f"{row['fault']}: none of these sizes"
    high = "beyond the largest" if row["high_m"] is None else f"{1e3 * row['high_m']:g} mm"
    low = 1e3 * (row["width_m"] if row["low_m"] is None else row["low_m"])
    return f"{row['fault']}: {1e3 * row['width_m']:g} mm ({low:g} mm to {high})"


def _analyses(found: dict[str, Any]) -> str:
    analyses = found["false_analyses"]
    said = f"Analyses of healthy runs with an alarm: {_rate(analyses)}."
    if found["monitor"]:
        return said
    rate = found["stated_false_alarm_rate"]
    allowed = f"{100 * rate:g} %: {rate * analyses['total']:.2g} of them"
    return f"{said} In stationary noise the threshold allows {allowed}."


def _check(found: dict[str, Any]) -> list[str]:
    check = found["check"]
    if check is None:
        return []
    low, middle, high = check["score_difference_dB"].values()
    lines = [
        "",
        f"## `{found['tier']}` against `{found['check_tier']}`",
        "",
        f"Some runs were repeated in the tier `{found['check_tier']}`: the same verdict in "
        f"{_rate(check['agreement'])}; false alarms there: {_rate(check['false_alarms'])}.",
    ]
    if middle is not None:
        lines.append(
            f"Where both found the spall its score in `{found['check_tier']}` was {middle:+.1f} dB away "
            f"(median; {low:+.1f} to {high:+.1f})."
        )
    lines += [
        f"- {row['run']}: {row['verdict']}, in the check {row['check_verdict']}" for row in check["different"]
    ]
    return lines


def _invalid(found: dict[str, Any]) -> list[str]:
    if not found["invalid"]:
        return []
    first = found["invalid"][0]
    return [
        "",
        f"{len(found['invalid'])} runs did not come to their end and count nowhere, such as "
        f"{first['run']}: {first['status']}",
    ]


if __name__ == "__main__":
    main()
