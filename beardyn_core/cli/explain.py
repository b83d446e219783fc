"""``beardyn explain``: which effects are on, why, and what each costs."""

from __future__ import annotations

import argparse
import math
import textwrap
from typing import TYPE_CHECKING, Any

from beardyn_core.cli.files import check_inputs, tell_doubts
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.options import add_choice, add_json, add_verbose, gather_choices

if TYPE_CHECKING:
    from beardyn_core.choice import Explanation
    from beardyn_core.choice.rule import Choice

DONE = 0
_WIDTH = 110


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "explain",
        help="show which effects a scene is computed with, why, and what each costs",
        description="Show which tier, slices (laminae), step and effects a scene is computed with, why, what "
        "each costs, and by how much the result can differ from the full model. For a scene that fixes them, "
        "also what `effects: auto` would be.",
    )
    parser.add_argument("scene", metavar="SCENE", help="shipped scene or YAML file")
    add_choice(parser)
    add_verbose(parser, "whole reasons, costs, slices, time step")
    add_json(parser)
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from beardyn_core.choice import explain_scene

    with check_inputs():
        found = explain_scene(args.scene, **gather_choices(args))
    tell_doubts(found.scene)
    print(json_text("explain", json_object(found)) if args.json else text(found, args.verbose))
    return DONE


def json_object(found: Explanation) -> dict[str, Any]:
    """Gather what ``--json`` prints."""
    from beardyn_core.choice.costs import measured_costs

    costs = measured_costs()
    return {
        "scene": found.scene.name,
        "current": found.current.to_json(),
        "automatic": None if found.automatic is None else found.automatic.to_json(),
        "costs": {"machine": costs.machine, "date": costs.date},
    }


def text(found: Explanation, verbose: bool = False) -> str:
    """Write the explanation for the terminal: an effect a line, or with ``verbose`` all reasons and costs."""
    if verbose:
        return _long_text(found)
    parts = [f"{found.scene.name}: {found.scene.purpose}", "", *_short_lines(found.current)]
    if found.automatic is not None:
        parts += ["", "`effects: auto` would choose:", *_head(found.automatic)]
    parts += [
        *_received(found),
        "",
        "--verbose: whole reasons, costs, slices, time step, and effects of both.",
    ]
    return "\n".join(parts)


def _head(choice: Choice) -> list[str]:
    """Write what is computed, how fast, and how near to the full model."""
    effects = sum(each.on for each in choice.decisions)
    return [
        f"  tier {choice.tier}, {effects} effects, {choice.laminae} slices of each roller; expected "
        f"real-time factor {choice.real_time_factor:.2g}",
        f"  asked for: {choice.asked}".replace("roller_load", "roller load"),
        f"  answer: {choice.phrase}",
    ]


def _short_lines(choice: Choice) -> list[str]:
    """Write a line for each effect: on or off, and the reason in a phrase."""
    lines = [*_head(choice), "", f"  {'':5}{'effect':20}why"]
    for decision in sorted(choice.decisions, key=lambda each: not each.on):
        phrase = decision.reason.split("; ")[0]
        if decision.word not in ("on", "off"):
            phrase = f"{decision.word.replace('_', ' ')}: {phrase}"
        phrase += decision.left_out.replace("roller_load", "roller load")
        phrase = textwrap.shorten(phrase, _WIDTH - 17, placeholder=" ...")
        lines.append(f"  {'on' if decision.on else 'off':5}{decision.effect:20}{phrase}")
    return lines


def _long_text(found: Explanation) -> str:
    """Write both choices with all reasons, costs and discretisation."""
    from beardyn_core.choice.costs import measured_costs

    costs = measured_costs()
    parts = [f"{found.scene.name}: {found.scene.purpose}"]
    if found.automatic is None:
        parts += ["", *_lines(found.current, "chosen")]
    else:
        parts += ["", *_lines(found.current, "as the scene has it")]
        parts += ["", *_lines(found.automatic, "what `effects: auto` would choose")]
    parts += _received(found)
    if (found.automatic or found.current).kept:
        from beardyn_core.choice.choice_cache import folder

        parts += ["", f"This choice was made before and kept in {folder()}."]
    parts += ["", f"Cost shares and real-time factor as measured on {costs.machine}, {costs.date}."]
    return "\n".join(parts)


def _received(explanation: Explanation) -> list[str]:
    """Name what sensors measure besides, paths that are filters and no model, bands that end too early."""
    from beardyn_core.base.edge import write_noun

    scene, found = explanation.scene, list(explanation.current.notes)
    if scene.background is not None:
        parts = [
            part for part in write_noun(scene.background) if part not in ("name", "description", "sources")
        ]
        found.append(f"background {scene.background.name}: {', '.join(parts)}")
    found += [
        f"sensor {sensor.name}: measured path {path.path.name} on {', '.join(path.axes)}, a filter behind "
        "the rigid box; rollers and raceways do not feel it"
        for sensor in scene.sensors
        for path in sensor.measured_paths
    ]
    return ["", *found] if found else []


def _lines(choice: Choice, title: str) -> list[str]:
    from beardyn_core.choice.costs import measured_costs
    from beardyn_core.physics.bodies.rates import WAVEFORM_RATE

    taken = sum(decision.cost_share for decision in choice.decisions if decision.on)
    rows = [
        ("tier", choice.tier, _share(1.0 - taken), choice.tier_reason),
        ("laminae", str(choice.laminae), "", choice.laminae_reason),
        ("step", f"1/{round(WAVEFORM_RATE * choice.steps_per_sample)} s", "", choice.steps_reason),
    ]
    if choice.rate is not None:
        rows.append(("rate", f"{1e-3 * choice.rate:g} kHz", "", choice.rate_reason))
    for decision in choice.decisions:
        share = _share(decision.cost_share) if decision.on else ""
        reason = f"{decision.reason}{decision.left_out}"
        cost_class = measured_costs().unmeasured(decision.effect) if decision.on else None
        if cost_class is not None:
            reason += f" (cost not measured, class {cost_class})"
        rows.append((decision.effect, decision.word, share, reason))
    lines = [
        f"{title}: tier {choice.tier}, {choice.laminae} laminae, "
        f"expected real-time factor {choice.real_time_factor:.2g}",
        f"asked for: {choice.asked}",
        choice.difference,
        f"{'':20} {'':20} {'cost':>7}  why",
    ]
    for name, word, share, reason in rows:
        first, *more = textwrap.wrap(reason, _WIDTH - 51) or [""]
        lines.append(f"{name:20} {word:20} {share:>7}  {first}")
        lines += [f"{'':51}{line}" for line in more]
    return lines


def _share(part: float) -> str:
    return f"{100.0 * part:.1f} %" if math.isfinite(part) else ""
