"""The data card of a set: what it is, how it was made, what it is not good for."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

from beardyn_core.base.edge import write_noun
from beardyn_core.bearing.cylindrical import CylindricalBearing
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.spherical import SphericalBearing
from beardyn_core.config.yaml_text import write_mapping
from beardyn_core.population.difficulty import card_lines
from beardyn_core.population.sweep_scenes import SweepScenes
from beardyn_core.population.table import unit_in

_MODELLED = {
    Bearing.kind: "a double-row tapered roller bearing",
    CylindricalBearing.kind: "a pair of cylindrical roller bearings",
    SphericalBearing.kind: "a spherical roller bearing",
}
_LIMITS = (
    "What the model leaves out is not in the signals; `docs/evidence/validation.md` and "
    "`docs/evidence/learner.md` of beardyn state how far they agree with measurements. "
    "A learner that is good on this set is not therefore good on a railway.",
    "The distributions are those of the sweep above: they are what was wanted, and not how often it is "
    "so in service.",
    "Failed runs stand in the table with their sentence; their signals end early, and are NaN from there on.",
)


def card_text(scenes: SweepScenes, about: Mapping[str, Any], rows: Sequence[Mapping[str, Any]]) -> str:
    """Write the card."""
    sweep = scenes.sweep
    conditions = Counter(str(row["condition"]) for row in rows if row["condition"])
    parts = about["parts"]
    bearings = len({row["bearing_id"] for row in rows if row["bearing_id"]})
    frame = scenes.frame
    sensors = "" if frame is None else ", ".join(f"{name} at {rate:g} Hz" for name, rate in frame.sensors)
    length = "" if frame is None else f"{frame.duration:g} s"
    lines = [
        f"# {sweep.name}: {len(rows)} simulated runs of {bearings} axlebox bearings",
        "",
        sweep.purpose,
        "",
        "| | |",
        "|---|---|",
        f"| runs | {len(rows)} of {about['runs']}, {about['failed']} failed |",
        f"| bearings | {bearings}, distinguished by drawing and scatter (`bearing_id`) |",
        f"| parts | {', '.join(f'{name} {count}' for name, count in parts.items())}; no bearing is in two |",
        f"| conditions | {', '.join(f'{name} {count}' for name, count in conditions.most_common())} |",
        f"| each run | {length}, {sensors} |",
        f"| tier | {scenes.base.get('tier', 'full')} |",
        f"| seed | {sweep.seed} |",
        f"| made | from {about['begun']} on, {about['processes']} processes, "
        f"{about['processor_seconds_a_run']['median']:.2f} s of a core a run |",
        f"| by | beardyn {about['versions']['beardyn']}, NumPy {about['versions']['numpy']}, numba "
        f"{about['versions']['numba']}; digest of the code {about['code']} |",
        f"| licence | {sweep.licence} |",
        "",
        "## Files",
        "",
        "- `signals.zarr`: signals, an array each (Zarr 3), runs along the first axis, SI units in `units`",
        "- `runs.parquet`: a row a run: part, bearing, status, every drawn key and every label, units in the "
        "metadata of the columns",
        "- `features.parquet`: what a monitor works out of each run, its verdict, and band levels",
        "- `set.json`: the sweep, the scene that every run starts from, versions",
        "- `SHA256SUMS`: checksums; `sha256sum -c SHA256SUMS` or `beardyn sweep -o DIR --verify` checks them",
        "",
        "```python",
        "import beardyn_core as bd",
        "",
        'runs = bd.open_set("DIR")',
        "runs.table            # pandas: a row a run",
        "runs.signals          # xarray, read when it is asked for",
        "```",
        "",
        "## How",
        "",
        "```yaml",
        write_mapping(_sweep(scenes)).rstrip(),
        "```",
        "",
    ]
    if scenes.chosen:
        lines += ["What the scene leaves open was chosen:", "", *(f"- {each}" for each in scenes.chosen), ""]
    lines += ["## Columns that were drawn", "", "| column | unit | from | to |", "|---|---|---|---|"]
    lines += [_column(variable.key, rows) for variable in sweep.vary]
    lines += [
        "",
        *card_lines(about["difficulty"]),
        "## Known limits",
        "",
        f"- Every run is simulated by a model of {_modelled(rows)} in an axlebox.",
        *(f"- {limit}" for limit in _LIMITS),
        "",
    ]
    return "\n".join(lines)


def _modelled(rows: Sequence[Mapping[str, Any]]) -> str:
    """Name the kinds of bearing of a set; of runs that never had a scene the kind is not known."""
    kinds = {row.get("bearing_kind") for row in rows}
    return " or ".join(words for kind, words in _MODELLED.items() if kind in kinds) or "a bearing"


def _sweep(scenes: SweepScenes) -> dict[str, Any]:
    found = write_noun(scenes.sweep)
    return {key: value for key, value in found.items() if value not in ({}, [], ())}


def _column(key: str, rows: Sequence[Mapping[str, Any]]) -> str:
    values = [row[key] for row in rows if row.get(key) is not None]
    numbers = [value for value in values if isinstance(value, int | float)]
    if not numbers:
        kinds = Counter(value if isinstance(value, str) else "mapping or list" for value in values)
        return f"| `{key}` | | {', '.join(f'{name} {count}' for name, count in kinds.most_common(8))} | |"
    none = len(rows) - len(values)
    absent = f" ({none} runs have none)" if none else ""
    return f"| `{key}` | {unit_in(key)} | {min(numbers):g} | {max(numbers):g}{absent} |"
