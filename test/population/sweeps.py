"""A sweep that takes a second: short runs of the cheapest tier on kernels that other tests compile too."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from beardyn_core.config import read_sweep
from beardyn_core.population.sweep_scenes import SweepScenes, scenes_of

TINY: dict[str, Any] = {
    "sweep": "tiny",
    "purpose": "what tests need",
    "scene": "smooth_run",
    "set": {"tier": "lumped", "effects": "standard", "scatter": {"grade": "G1"}, "duration_s": 0.2},
    "runs": 6,
    "runs_per_task": 2,
    "vary": [
        {
            "key": "defects",
            "kind": "choice",
            "one_of": [[], [{"kind": "spall", "on": "cup", "row": 0, "width_mm": 4, "depth_um": 100}]],
        },
        {"key": "defects[0].width_mm", "kind": "log_uniform", "low": 2, "high": 12},
        {"key": "defects[0].length_mm", "kind": "scaled", "by": "defects[0].width_mm", "times": 2},
        {"key": "operation.speed_profile[0].speed_kmh", "kind": "uniform", "low": 80, "high": 200},
    ],
}


def tiny(**changes: Any) -> dict[str, Any]:
    """Give the keys of the tiny sweep, some changed."""
    return {**TINY, **changes}


def planned(**changes: Any) -> SweepScenes:
    """SweepScenes the tiny sweep, some keys changed."""
    return scenes_of(*read_sweep(tiny(**changes)))


def content(folder: Path) -> dict[str, bytes]:
    """Bytes of tables and signals."""
    files = [folder / name for name in ("runs.parquet", "features.parquet")] + [
        p for p in (folder / "signals.zarr").rglob("*") if p.is_file()
    ]
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in files}
