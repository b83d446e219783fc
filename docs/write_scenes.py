"""Write docs/scenes.md and its pictures from the shipped scenes: ``python docs/write_scenes.py``.

``--check`` writes nothing and ends with 1 when the page is not that of the scenes or a picture is missing.
``--measured`` makes the CSV file of the scene measured_run from the rail model.
"""

from __future__ import annotations

import io
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, get_args

import numpy as np
from pydantic import BaseModel

from beardyn_core.config import read_scene, shipped_names
from beardyn_core.config.folders import find
from beardyn_core.config.keys import keys_of
from beardyn_core.rail.build import load_history, load_of_scene
from beardyn_core.rail.events import events_of
from beardyn_core.rail.roughness import select_roughness
from beardyn_core.rail.spectra import spectral_density
from beardyn_core.scene.excitation import SPECTRA, VERTICAL_ONLY, RailDefect, WheelDefect
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import Irregularity, MeasuredOperation, QuarterVehicleOperation
from beardyn_core.scene.scene import Scene

sys.path.insert(0, str(Path(__file__).parents[1]))
from evidence.stamps import stamp

PAGE = Path(__file__).with_name("scenes.md")
FOLDER = Path(__file__).with_name("pictures") / "scenes"
SIGNALS = Path(__file__).with_name("pictures") / "signals"  # of write_signals.py
LARGEST_PICTURE = 40_000
COLOURS = 16

HEAD = """# Scenes

A scene is a YAML file with a bearing, a lubricant, an operation, faults and sensors. `beardyn simulate
cup_spall` runs a shipped one, `beardyn new cup_spall -o mine.yaml` copies it, `beardyn simulate
mine.yaml` runs your own. This page is written by `python docs/write_scenes.py` from `config/scenes`.

Railway scenes test a monitor. Some have a fault that must be found, some only a *similar disturbance*,
some both, healthy ones nothing. The truth of a run (topic `truth`, key `excitation`) has the
irregularity with its seed, strikes of a flat and joints passed, each with time and distance. Their
bearings are as made, [grade G1](scatter.md). Bearings under a constant load, at the end of the page,
are as drawn.

Scenes name no effects, or only the box that rings (`santos_*`, of a publication, name all). Each is
computed with those that it [needs](effects_auto.md) to stay within 5 % of the full model
([choices](evidence/choices.md)). `bogie` names the tier `quasistatic`, so that its four boxes keep up.
It misses 5 %, and states by how much. It has [several axleboxes at
once](rail.md#several-axleboxes-at-once); its picture is of the first wheel.

Pictures show the vertical load on the journal (line: mean, band: least and greatest) and the speed.
Red triangles are strikes, joints, welds and crossings, and where a train stops or starts.
Yellow stretches are curves and corrugation. Second pictures (tier `quasistatic`, `python
docs/write_signals.py`) show the vertical vibration of the axlebox, its spectrum, and that of its envelope
between 2 and 8 kHz. Dotted are the orders of faults of outer ring (cup), inner ring (cone) and roller.

## Railway scenes
"""

MEASURED = """
## Measured input

A CSV file names its columns in the first line. A second one may give their units. Lines that begin with
`#` are comments. All mistakes are reported at once, with file, line and what is allowed.

| file | key | columns |
|---|---|---|
| load and speed | `operation: {kind: csv, path: run.csv}` | `time_s`, `speed_rpm` or `shaft_speed_rad_s`, \
`fx_N`, `fy_N`, `fz_N`; perhaps `mx_Nm`, `my_Nm`, `mz_Nm`; \
`ux_m`, `uy_m`, `uz_m` (bogie end of the suspension) |
| only the load | `operation: {kind: csv, path: run.csv, take: force, speed_profile: [...]}` | without a \
speed |
| only the speed | `operation: {kind: csv, path: run.csv, take: speed, force_kN: [0, 0, 80]}` | `time_s` and \
a speed |
| speed under a vehicle model | `operation: {kind: quarter_vehicle, measured_speed: run.csv, ...}` | \
`time_s` and a speed of the shaft |
| the rail | `irregularity: {kind: csv, path: rail.csv}` | `distance_m`, `vertical_mm`, perhaps `lateral_mm` |
| a spectrum of the rail | `irregularity: {kind: density_csv, path: density.csv}` | `wavelength_m`, \
`vertical_mm2_m`, perhaps `lateral_mm2_m`: one-sided, over cycles per metre |

`kind: mcap` takes a recording in place of the CSV file, and so does `measured_speed`: its `load/blocks`,
sample by sample the same load; else `load/wrench` and `load/shaft`; else `force` and `shaft` of a twin,
which is the load less the inertia of the journal.
"""


def railway(scene: Scene) -> bool:
    """Whether a scene is an operation of a train."""
    return isinstance(scene.operation, (QuarterVehicleOperation, MeasuredOperation))


def friends(scene: Scene) -> str:
    """Describe what a monitor may mistake for a fault."""
    kinds = [event["kind"].replace("_", " ") for event in events_of(scene)["events"]]
    strange = [kind for kind in dict.fromkeys(kinds) if kind not in ("standstill", "forwards", "backwards")]
    besides = [] if scene.background is None else [f"background `{scene.background.name}`"]
    return ", ".join([*strange, *besides])


def faults(scene: Scene) -> str:
    """Describe the faults of a bearing, and in which axleboxes of several they are."""
    found = "; ".join(scene.fault_sentences)
    if scene.axleboxes is None or not found:
        return found
    return f"{found}, in {', '.join(scene.axleboxes.faulty)} of {len(scene.axleboxes.boxes)} axleboxes"


def speeds(scene: Scene) -> str:
    """Speeds of the profile, [km/h]."""
    if isinstance(scene.operation, QuarterVehicleOperation):
        found = [f"{3.6 * speed:.0f}" for _, speed in scene.operation.speed_profile]
        steps = [one for one, before in zip(found, ["", *found], strict=False) if one != before]
        return " → ".join(steps)
    return "measured"


def irregularity(scene: Scene) -> str:
    """Name of the rail's irregularity."""
    if not isinstance(scene.operation, QuarterVehicleOperation):
        return ""
    rail = scene.operation.irregularity
    roughness, _ = select_roughness(rail, scene.background)
    return f"`{rail.kind}`" + (f", `{roughness.rail}`" if roughness.rail != "none" else "")


def page() -> str:
    """Write the whole page."""
    scenes = [read_scene(name).scene for name in shipped_names("scenes")]
    lines = [HEAD, "| scene | km/h | rail | fault | similar disturbances |", "|---|---|---|---|---|"]
    for scene in filter(railway, scenes):
        cells = (f"[{scene.name}](#{scene.name})", speeds(scene), irregularity(scene))
        lines.append("| " + " | ".join((*cells, faults(scene), friends(scene))) + " |")
    lines.append("")
    for scene in filter(railway, scenes):
        lines += [
            f"### {scene.name}",
            "",
            scene.purpose,
            "",
            f"![{scene.name}](pictures/scenes/{scene.name}.png)",
            "",
        ]
        if (SIGNALS / f"{scene.name}.png").exists():
            lines += [f"![{scene.name}, vibration and spectra](pictures/signals/{scene.name}.png)", ""]
    lines += ["## Scenes under a constant load", "", "| scene | purpose |", "|---|---|"]
    lines += [f"| `{scene.name}` | {scene.purpose} |" for scene in scenes if not railway(scene)]
    lines += ["", "## Irregularity", "", *_irregularities(), "", "## Defects of wheel and rail", ""]
    lines += [*_defects(), MEASURED.strip("\n")]
    return "\n".join(lines) + "\n"


def _irregularities() -> Iterator[str]:
    yield "Keys of `irregularity`. A spectrum ends at 2 m, as its source does; `short_waves` gives the"
    yield "roughness of the rail below. [Sensors](evidence/sensors.md#lines-and-wheels) compares the levels."
    yield ""
    yield from _options(keys_of(Irregularity))
    yield ""
    yield "Standard deviations over waves of 3 to 25 m and of 3 to 150 m:"
    yield ""
    yield "| kind | vertical, mm | lateral, mm |"
    yield "|---|---|---|"
    for kind in SPECTRA:
        cells = []
        for direction in ("vertical", "lateral"):
            if direction == "lateral" and kind in VERTICAL_ONLY:
                cells.append("the source has none")
            else:
                cells.append(", ".join(f"{_deviation(kind, direction, to):.2f}" for to in (25.0, 150.0)))
        yield f"| `{kind}` | {' | '.join(cells)} |"


def _deviation(kind: str, direction: str, longest: float) -> float:
    """Compute the standard deviation over 3 m to the longest wave, [mm]."""
    wavenumber = np.geomspace(2.0 * np.pi / longest, 2.0 * np.pi / 3.0, 20_001)
    density = spectral_density(kind, wavenumber, direction)
    return float(1e3 * np.sqrt(np.sum(0.5 * (density[1:] + density[:-1]) * np.diff(wavenumber))))


def _options(model: type[BaseModel]) -> Iterator[str]:
    yield "| key | usual | |"
    yield "|---|---|---|"
    for name, field in model.model_fields.items():
        if name == "kind" and len(get_args(field.annotation)) == 1:
            continue
        usual = "required" if field.is_required() else field.get_default(call_default_factory=True)
        shown = "" if usual is None else f"`{usual}`" if usual != "required" else usual
        yield f"| `{name}` | {shown} | {field.description or ''} |"


def _defects() -> Iterator[str]:
    for key, nouns in (("wheel_defects", get_args(WheelDefect)), ("rail_defects", get_args(RailDefect))):
        for noun in nouns:
            yield f"### {key}: `{{kind: {noun.kind}}}`"
            yield ""
            yield noun.__doc__.splitlines()[0]
            yield ""
            yield from _options(keys_of(noun))
            yield ""


def picture(scene: Scene) -> bytes:
    """PNG of load and speed over the time, with what the run meets."""
    import matplotlib as mpl

    mpl.use("Agg")
    import matplotlib.pyplot as plt
    from PIL import Image

    history = load_of_scene(scene, scene.duration)
    time = history.time_ns * 1e-9
    size = {"height_ratios": [3, 1.2]}
    figure, (load, speed) = plt.subplots(2, 1, sharex=True, figsize=(6.4, 2.9), dpi=100, gridspec_kw=size)
    low, mean, high = _envelope(history.wrench[:, 2] * 1e-3, 900)
    at = np.linspace(0.0, time[-1], len(mean))
    load.fill_between(at, low, high, color="#7aa6c2", linewidth=0)
    load.plot(at, mean, color="#1f4e79", linewidth=0.8)
    load.set_ylabel("load, kN")
    speed.plot(time, history.shaft_speed * 30.0 / np.pi, color="#1f4e79", linewidth=1.0)
    speed.set_ylabel("rpm")
    speed.set_xlabel("time, s")
    speed.margins(y=0.3)
    for event in events_of(scene)["events"]:
        _mark(load, event)
    load.set_xlim(0.0, time[-1])
    figure.align_ylabels()
    figure.tight_layout(pad=0.4)
    drawn = io.BytesIO()
    figure.savefig(drawn, format="png")
    plt.close(figure)
    small = io.BytesIO()
    # few pixels are red; another way to choose colours would lose them
    few = Image.open(drawn).convert("RGB").quantize(COLOURS, Image.Quantize.MAXCOVERAGE)
    few.save(small, format="png", optimize=True)
    return small.getvalue()


def _envelope(signal: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Least, mean and greatest of equal stretches."""
    parts = np.array_split(signal, min(count, len(signal)))
    found = np.array([(part.min(), part.mean(), part.max()) for part in parts])
    return found[:, 0], found[:, 1], found[:, 2]


def _mark(axes: Any, event: dict[str, Any]) -> None:
    if event.get("begin_s") is not None:
        axes.axvspan(event["begin_s"], event["end_s"], color="#f2d9a0", linewidth=0, zorder=0)
    marks = event.get("time_s", [])
    if not marks:
        return
    axes.plot(marks, np.full(len(marks), 0.97), "v", color="#c0392b", markersize=4,
              transform=axes.get_xaxis_transform(), clip_on=False)  # fmt: skip


def problems() -> list[str]:
    """List what of the page and its pictures differs from the scenes."""
    found = []
    if not PAGE.exists() or PAGE.read_text(encoding="utf-8") != page():
        found.append(f"{PAGE.name} is not what the scenes say: python docs/write_scenes.py")
    for name in filter(lambda name: railway(read_scene(name).scene), shipped_names("scenes")):
        path = FOLDER / f"{name}.png"
        if not path.exists():
            found.append(f"{path.name} is missing: python docs/write_scenes.py")
        elif path.stat().st_size >= LARGEST_PICTURE:
            found.append(
                f"{path.name} has {path.stat().st_size} bytes; less than {LARGEST_PICTURE} are allowed"
            )
    found += [
        f"signals/{path.name} has {path.stat().st_size} bytes; less than {LARGEST_PICTURE} are allowed"
        for path in sorted(SIGNALS.glob("*.png"))
        if path.stat().st_size >= LARGEST_PICTURE
    ]
    return found


def write_measured() -> None:
    """Make the CSV file of measured_run: a coach on the rail model, filtered to 40 Hz, 100 rows a second."""
    coach = read_scene("healthy_80").scene.operation
    assert isinstance(coach, QuarterVehicleOperation)
    operation = QuarterVehicleOperation(
        coach.vehicle, Irregularity("german_high", 0.5), ((0.0, 100 / 3.6), (1.0, 100 / 3.6), (5.0, 85 / 3.6))
    )
    history = load_history(operation, Mounting(), 5.5, 58)
    kernel = np.hanning(41)
    force = np.convolve(np.pad(history.wrench[:, 2], 20, mode="edge"), kernel / kernel.sum(), mode="valid")
    rpm = history.shaft_speed * 30.0 / np.pi
    rows = ["# load of a coach on track german_high, from the rail model, smoothed over 20 ms"]
    rows += ["time_s,speed_rpm,fx_N,fy_N,fz_N", "s,rpm,N,N,N"]
    for at in range(0, len(history), 20):
        rows.append(f"{history.time_ns[at] * 1e-9:.2f},{rpm[at]:.2f},0,0,{force[at]:.0f}")
    target = find("scenes", "healthy_80").with_name("measured_run.csv")
    target.write_text("\n".join(rows) + "\n", encoding="utf-8")


def main(arguments: list[str]) -> int:
    """Write, or check."""
    if arguments == ["--measured"]:
        write_measured()
        return 0
    if arguments == ["--check"]:
        found = problems()
        print("\n".join(found), file=sys.stderr, end="\n" if found else "")
        return 1 if found else 0
    if arguments:
        print(__doc__, file=sys.stderr)
        return 2
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name in shipped_names("scenes"):
        if railway(scene := read_scene(name).scene):
            path = FOLDER / f"{name}.png"
            path.write_bytes(picture(scene))
            stamp(path)
    PAGE.write_text(page(), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
