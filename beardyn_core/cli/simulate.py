"""``beardyn simulate``: a desk run of a scene, recorded if asked for."""

from __future__ import annotations

import argparse
import json
import math
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from beardyn_core.errors import InputError

if TYPE_CHECKING:
    from beardyn_core.observe.block import Block
    from beardyn_core.study.desk_run import RunSummary

DONE, INVALID = 0, 3
_ZERO_CELSIUS = 273.15  # [K]


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "simulate",
        help="run a scene as fast as this machine can, with a recording if asked for",
        description="Run a scene as fast as this machine can. Exit code 2: bad input, nothing written, or a "
        "disk that is full; 3: the model left its range of validity, the recording up to there is closed and "
        "readable.",
    )
    parser.add_argument("scene", metavar="SCENE", help="shipped scene or YAML file")
    parser.add_argument("-o", "--output", metavar="run.mcap", type=Path, help="record the run to this file")
    parser.add_argument("--duration", metavar="S", type=float, help="simulated time, s (the scene's own)")
    parser.add_argument("--effects", metavar="NAME", help="preset or file of effects, or auto")
    parser.add_argument("--tier", metavar="T", help="lumped, quasistatic, full or auto")
    parser.add_argument("--laminae", metavar="N", type=int, help="laminae of each roller (the scene's own)")
    parser.add_argument("--accuracy", metavar="PERCENT", type=float, help="that auto is chosen for")
    parser.add_argument("--quantities", metavar="NAMES", help="that auto is chosen for, commas between")
    parser.add_argument("--seed", metavar="N", type=int, help="of irregularity and noise (the scene's own)")
    parser.add_argument("--json", action="store_true", help="print one JSON object, nothing else, on stdout")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from beardyn_core.choice import load_scene

    problems = [] if args.output is None else output_problems(args.output)
    try:
        scene = load_scene(
            args.scene,
            effects=args.effects,
            tier=args.tier,
            duration=args.duration,
            laminae=args.laminae,
            seed=args.seed,
            accuracy_percent=args.accuracy,
            quantities=None if args.quantities is None else args.quantities.split(","),
        )
    except InputError as error:
        named = [p.replace("--accuracy_percent", "--accuracy") for p in error.problems]
        raise InputError([*named, *problems]) from None
    if problems:
        raise InputError(problems)

    from tqdm import tqdm

    from beardyn_core.record.sinks import McapSink
    from beardyn_core.study import desk_run

    print(f"beardyn: {scene.name}, {scene.purpose}", file=sys.stderr)
    sinks = [] if args.output is None else [McapSink(args.output)]
    bar_format = "{desc} {bar} {n:.2f}/{total:.2f} s{postfix} [{elapsed}<{remaining}]"
    with tqdm(
        total=scene.duration, desc="simulated", bar_format=bar_format, disable=None, leave=False
    ) as bar:
        summary = desk_run.run(scene, sinks, _Progress(bar))
    if args.json:
        print(json.dumps(json_object(summary, args.output)))
    else:
        print(text(summary, args.output))
    if not summary.complete:
        print(f"beardyn: {summary.status}", file=sys.stderr)
    return DONE if summary.complete else INVALID


def output_problems(path: Path) -> list[str]:
    """Why a recording cannot be written to a path; nothing is created."""
    folder = path.parent
    if path.is_dir():
        return [f"--output {path}: is a folder; give the name of a file, such as {path / 'run.mcap'}"]
    if not folder.is_dir():
        return [f"--output {path}: the folder {folder} does not exist; create it or choose another"]
    if not os.access(path if path.exists() else folder, os.W_OK):
        return [f"--output {path}: cannot be written; choose a file you may write to"]
    return []


class _Progress:
    """Moves the bar and shows the real-time factor so far."""

    def __init__(self, bar: Any) -> None:
        self._bar = bar
        self._simulated = 0.0
        self._wall = 0.0

    def __call__(self, block: Block) -> None:
        step = (block.end_ns - block.start_ns) * 1e-9
        self._simulated += step
        self._wall += block.wall_s
        if self._wall > 0.0:
            self._bar.set_postfix_str(f"RTF {self._simulated / self._wall:.2f}", refresh=False)
        self._bar.update(min(step, max(self._bar.total - self._bar.n, 0.0)))


def _number(value: float | None) -> float | None:
    """JSON has no NaN."""
    return None if value is None or not math.isfinite(value) else value


def json_object(summary: RunSummary, recording: Path | None) -> dict[str, Any]:
    """What ``--json`` prints."""
    from beardyn_core.study.life_text import life_object

    return {
        "scene": summary.scene,
        "tier": summary.tier,
        "effects": list(summary.effects),
        "not_in_tier": list(summary.not_in_tier),
        "faults": list(summary.faults),
        "duration_s": summary.duration,
        "wall_s": summary.wall_time,
        "rtf": _number(summary.real_time_factor),
        "status": summary.status,
        "mean_force_N": [_number(component) for component in summary.mean_force],
        "shaft_torque_Nm": _number(summary.shaft_torque),
        "cage_speed_ratio": [_number(ratio) for ratio in summary.cage_speed_ratio],
        "energy_residual": _number(summary.energy_residual),
        "life": None if summary.life is None else life_object(summary.life),
        "torque_budget": None if summary.budget is None else summary.budget.to_json(),
        **(
            {"temperatures_C": {part: kelvin - _ZERO_CELSIUS for part, kelvin in summary.temperatures}}
            if summary.temperatures
            else {}
        ),
        "stages_s": {each.stage: each.seconds for each in summary.stages},
        "recording": None if recording is None else str(recording),
    }


def _means(summary: RunSummary) -> list[tuple[str, str]]:
    """Lines of the mean values."""
    if summary.nothing_to_average:
        why = f"too little: {summary.duration:g} s end before the first values have passed their filters"
        return [("means", f"{why}; simulate 0.06 s or more")]
    fx, fy, fz = summary.mean_force
    first, last = summary.averaged
    ratios = (
        "none, the shaft stands still"
        if any(math.isnan(ratio) for ratio in summary.cage_speed_ratio)
        else ", ".join(f"{ratio:.4f} (row {row})" for row, ratio in enumerate(summary.cage_speed_ratio))
    )
    over = (
        f"{summary.cage_revolutions} whole cage revolution{'s' * (summary.cage_revolutions != 1)}"
        if summary.cage_revolutions
        else "no whole cage revolution"
    )
    return [
        ("means over", f"{first:.3f} s to {last:.3f} s, {over}"),
        ("force on the cup", f"x {fx:.1f} N, y {fy:.1f} N, z {fz:.1f} N"),
        ("torque on the shaft", f"{summary.shaft_torque:.3f} N m"),
        ("cage speed ratio", ratios),
    ]


def text(summary: RunSummary, recording: Path | None) -> str:
    """Readable summary."""
    from beardyn_core.observe.stage_clock import stage_lines
    from beardyn_core.study.life_text import life_sentence

    residual = "not kept" if summary.energy_residual is None else f"{100.0 * summary.energy_residual:.3f} %"
    lines = [
        ("scene", summary.scene),
        ("tier", summary.tier),
        ("effects", ", ".join(summary.effects) or "none"),
        *([("not in this tier", ", ".join(summary.not_in_tier))] if summary.not_in_tier else []),
        ("faults", "; ".join(summary.faults) or "none"),
        (
            "simulated",
            f"{summary.duration:.2f} s in {summary.wall_time:.2f} s, "
            f"real-time factor {summary.real_time_factor:.2f}",
        ),
        *_means(summary),
        ("energy residual", residual),
        ("status", summary.status),
    ]
    if summary.temperatures:
        parts = (f"{part} {kelvin - _ZERO_CELSIUS:.1f}" for part, kelvin in summary.temperatures)
        lines.insert(-1, ("temperatures", f"{', '.join(parts)} °C"))
    if summary.life is not None:
        lines.insert(-1, ("rating life", life_sentence(summary.life)))
    if recording is not None:
        size = f", {recording.stat().st_size / 1e6:.1f} MB" if recording.exists() else ""
        lines.append(("recording", f"{recording}{size}"))
    table = [] if summary.budget is None else ["", *summary.budget.lines()]
    if summary.stages:
        table += ["", *stage_lines(summary.stages, summary.duration)]
    return "\n".join([*(f"{name:20} {value}" for name, value in lines), *table])
