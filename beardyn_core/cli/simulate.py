"""``beardyn simulate``: a desk run of a scene, recorded if asked for."""

from __future__ import annotations

import argparse
import math
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from beardyn_core.api.simulating import simulate
from beardyn_core.base.interrupts import last_words
from beardyn_core.base.outputs import recording_problems
from beardyn_core.base.units import ZERO_CELSIUS
from beardyn_core.cli.files import check_inputs, tell_doubts
from beardyn_core.cli.generated_parser import add_command, add_parameter
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.options import add_choice, add_json, add_verbose, gather_choices

if TYPE_CHECKING:
    from beardyn_core.sensors.block import Block
    from beardyn_core.study.desk_run import RunSummary

DONE, INVALID = 0, 3
_RPM = math.pi / 30.0
_RINGS = {
    "elastic": "elastic: the cup bends in its housing (effect structure)",
    "rigid": "rigid: only the contacts yield (no effect structure)",
}


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    more = (
        "Exit code 2: bad input, nothing written, or a disk that is full; 3: the model left its range of "
        "validity, the recording up to there is closed and readable."
    )
    parser = add_command(subparsers, "simulate", simulate, more)
    add_parameter(parser, simulate, "scene", "scene", metavar="SCENE", type=str)
    add_parameter(parser, simulate, "record", "-o", "--output", metavar="run.mcap")
    add_parameter(parser, simulate, "duration", metavar="S")
    add_choice(parser)
    add_parameter(parser, simulate, "laminae", metavar="N")
    add_parameter(parser, simulate, "seed", metavar="N")
    add_parameter(parser, simulate, "rings", metavar="KIND")
    add_parameter(parser, simulate, "snapshot_rate", metavar="HZ")
    add_parameter(parser, simulate, "force")
    add_verbose(parser, "effects, bounds of the accuracy, means, lives, losses, wall time")
    add_json(parser)
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from beardyn_core.choice.load import complete_scene
    from beardyn_core.config.load import read_scene

    with check_inputs(
        lambda inputs: recording_problems("--output", args.output, inputs=inputs, force=args.force)
    ):
        found = read_scene(args.scene, changes_of(args))
    with check_inputs():  # apart, for to choose effects takes long
        scene = complete_scene(found)

    if scene.axleboxes is not None:
        from beardyn_core.cli import simulate_train

        return simulate_train.run(scene, args)
    from tqdm import tqdm

    from beardyn_core.record.sinks import McapSink
    from beardyn_core.study import desk_run

    print("beardyn: " + ", ".join(filter(None, (scene.name, scene.purpose))), file=sys.stderr)
    tell_doubts(scene)
    sinks = [] if args.output is None else [McapSink(args.output, replace=args.force)]
    bar_format = "{desc} {bar} {n:.2f}/{total:.2f} s{postfix} [{elapsed}<{remaining}]"
    with tqdm(
        total=scene.duration, desc="simulated", bar_format=bar_format, disable=None, leave=False
    ) as bar:
        progress = _Progress(bar)
        with last_words(lambda: progress.kept(args.output)):
            summary = desk_run.run(scene, sinks, progress)
    if args.json:
        print(json_text("simulate", json_object(summary, args.output)))
    else:
        print(text(summary, args.output, args.verbose))
    for sensor, count, total in summary.clipped:
        print(
            f"beardyn: warning: the accelerometer {sensor} has clipped {count} of {total} samples; give it a "
            "larger range_m_per_s2",
            file=sys.stderr,
        )
    if not summary.complete:
        print(f"beardyn: {summary.status}", file=sys.stderr)
    return DONE if summary.complete else INVALID


def changes_of(args: argparse.Namespace) -> dict[tuple[str | int, ...], Any]:
    """Gather the options that stand in place of keys of the scene, by the place of the key."""
    places: dict[str, tuple[str | int, ...]] = {
        "duration": ("duration_s",),
        "laminae": ("numerics", "laminae"),
        "vibration_to": ("vibration_to_Hz",),
        "snapshot_rate": ("snapshot_rate_Hz",),
    }
    named = ("duration", "laminae", "seed", "snapshot_rate")
    given = {name: getattr(args, name) for name in named}
    given |= {**gather_choices(args), "rings": args.rings}  # rings are those of the effects before
    return {places.get(name, (name,)): value for name, value in given.items() if value is not None}


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
            self._bar.set_postfix_str(f"real-time factor {self._simulated / self._wall:.2f}", refresh=False)
        self._bar.update(min(step, max(self._bar.total - self._bar.n, 0.0)))

    def kept(self, recording: Path | None) -> str:
        """Say what an interrupted run has left behind."""
        if recording is None or not self._simulated:
            return "nothing has been written"
        return f"{recording} holds the run until {self._simulated:.2f} s, and is closed and readable"


def json_object(summary: RunSummary, recording: Path | None) -> dict[str, Any]:
    """Gather what ``--json`` prints."""
    from beardyn_core.physics.statics.rating_life import life_object

    return {
        "scene": summary.scene,
        "tier": summary.tier,
        "effects": summary.effects,
        "not_in_tier": summary.not_in_tier,
        "rings": summary.rings,
        "chosen": summary.chosen or None,
        "faults": summary.faults,
        "clipped_samples": {sensor: count for sensor, count, _ in summary.clipped},
        "duration_s": summary.duration,
        "wall_time_s": summary.wall_time,
        "real_time_factor": summary.real_time_factor,
        "status": summary.status,
        "mean_force_N": summary.mean_force,
        "shaft_torque_N_m": summary.shaft_torque,
        "cage_speed_ratio": summary.cage_speed_ratio,
        "energy_residual": summary.energy_residual,
        "largest_roller_load_N": summary.largest_roller_load,
        "largest_pressure_Pa": summary.largest_pressure,
        "shaft_speed_rad_per_s": summary.shaft_speed,
        "life": None
        if (life := summary.life) is None
        else {**life_object(life), "L10mr_m": life.distance(summary.wheel_diameter)},
        "torque_budget": None if summary.budget is None else summary.budget.to_json(),
        "temperature_K": dict(summary.temperatures) or None,
        "stages_s": {each.stage: each.seconds for each in summary.stages},
        "recording": recording,
    }


def _means(summary: RunSummary) -> list[tuple[str, str]]:
    """Write the means to all digits, and the time that they are taken over."""
    if summary.nothing_to_average:
        return []
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


def text(summary: RunSummary, recording: Path | None, verbose: bool = False) -> str:
    """Write the summary for the terminal: the answers, and with ``verbose`` how they came about."""
    return "\n".join([*_answers(summary, recording), *(["", *_details(summary)] if verbose else [])])


def _answers(summary: RunSummary, recording: Path | None) -> list[str]:
    """Write what ran, what it gives up, what came out of it and where it is."""
    from beardyn_core.choice.rule import shorten_summary

    absent = f", without {', '.join(summary.not_in_tier)}" if summary.not_in_tier else ""
    lines = [
        ("scene", f"{summary.scene}: {'; '.join(summary.faults) or 'healthy'}"),
        (
            "computed",
            f"tier {summary.tier}, {len(summary.effects)} effects{absent}, {summary.rings} rings; "
            f"{summary.duration:.2f} s in {summary.wall_time:.2f} s, real-time factor "
            f"{summary.real_time_factor:.2g}",
        ),
        *([("accuracy", shorten_summary(summary.chosen))] if summary.chosen else []),
        *_results(summary),
    ]
    if summary.temperatures:
        parts = (f"{part} {kelvin - ZERO_CELSIUS:.1f}" for part, kelvin in summary.temperatures)
        lines.append(("temperatures", f"{', '.join(parts)} °C"))
    if summary.life is not None:
        lines.append(("life", _life_words(summary)))
    lines.append(("status", summary.status))
    if recording is not None:
        size = f", {recording.stat().st_size / 1e6:.1f} MB" if recording.exists() else ""
        lines.append(("recording", f"{recording}{size}"))
    return [f"{name:12} {value}" for name, value in lines]


def _results(summary: RunSummary) -> list[tuple[str, str]]:
    """Write forces, torque and speed of a run."""
    if summary.nothing_to_average:
        why = f"too little: {summary.duration:g} s end before the first values have passed their filters"
        return [("means", f"{why}; simulate 0.06 s or more")]
    fx, fy, fz = (f"{round(each * 1e-3, 2) + 0.0:.2f}" for each in summary.mean_force)
    force = f"on the cup x {fx}, y {fy}, z {fz} kN"
    if math.isfinite(summary.largest_roller_load):
        force += f"; largest roller load {summary.largest_roller_load * 1e-3:.3g} kN"
    if math.isfinite(summary.largest_pressure):
        force += f", Hertz pressure {summary.largest_pressure * 1e-9:.2f} GPa"
    torque = f"{abs(summary.shaft_torque):.3g} N m at {abs(summary.shaft_speed) / _RPM:.4g} rpm"
    if all(math.isfinite(ratio) for ratio in summary.cage_speed_ratio):
        ratios = ", ".join(f"{ratio:.4f}" for ratio in summary.cage_speed_ratio)
        torque += f"; cage speed over that of pure rolling {ratios}"
    return [("force", force), ("torque", torque)]


def _life_words(summary: RunSummary) -> str:
    """Write the modified life in revolutions and, where a wheel is known, in kilometres."""
    assert summary.life is not None
    life = summary.life.reference_modified
    if not math.isfinite(life):
        return "endless (ISO 16281, modified)"
    distance = summary.life.distance(summary.wheel_diameter)
    way = "" if distance is None else f", {_to_three_digits(distance * 1e-9)} million km"
    return (
        f"{_to_three_digits(life * 1e-6)} million revolutions{way} at 90 % reliability (ISO 16281, modified)"
    )


def _to_three_digits(number: float) -> str:
    """Write a number to three digits, thousands with commas."""
    return f"{float(f'{number:.3g}'):,.0f}" if number >= 100.0 else f"{number:.3g}"


def _details(summary: RunSummary) -> list[str]:
    """Write how the answers came about: effects, bounds, means, lives, losses, wall time."""
    from beardyn_core.physics.statics.rating_life import life_sentence
    from beardyn_core.sensors.stage_clock import stage_lines

    residual = "not kept" if summary.energy_residual is None else f"{100.0 * summary.energy_residual:.3f} %"
    lines = [
        ("effects", ", ".join(summary.effects) or "none"),
        *([("", summary.chosen)] if summary.chosen else []),
        ("rings", _RINGS[summary.rings]),
        *_means(summary),
        *([] if summary.life is None else [("rating life", life_sentence(summary.life))]),
        ("energy residual", residual),
    ]
    table = [] if summary.budget is None else ["", *summary.budget.lines()]
    if summary.stages:
        table += ["", *stage_lines(summary.stages, summary.duration)]
    return [*(f"{name:20} {value}" for name, value in lines), *table]
