"""Cost of every effect: time per step of sets that differ from `standard` by one of them, and of `full`.

Tiers and lamina counts are measured along. ``--write`` puts the ratios into the file that `effects: auto`
reads, `beardyn_core/choice/costs.json`; with ``--only`` it replaces what was measured and keeps the rest.

All sets take turns, block by block, so that a machine that slows down slows all of them; the ratios are
medians over the turns. Sets also differ in how their code and data happen to lie in memory, up to 5 % either
way and from run to run. Each set is compiled the first time (half a minute each). Run it on an idle machine:
``python benchmarks/effect_costs.py [--turns N] [--only NAME ...] [--json FILE] [--write]``.
"""

from __future__ import annotations

import argparse
import datetime
import json
import platform
import statistics
import time
from collections.abc import Callable
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path
from typing import Any

from beardyn_core.choice import load_scene
from beardyn_core.choice.costs import COST_FILE
from beardyn_core.config import load_effects
from beardyn_core.effects import (
    Cage,
    CoulombTraction,
    Drag,
    EffectSet,
    KinematicCage,
    LaminaCoupling,
    LandGuidance,
    LineFilm,
    LoadSharingTraction,
    ModalStructure,
    PocketFilm,
    Rib,
    RibMixedFilm,
    RibShearedFilm,
    RingStructure,
    RollingResistance,
    RotatingCage,
    Seal,
    ShearedFilmTraction,
    SmallRib,
    Thermal,
)
from beardyn_core.effects.catalogue import catalogue
from beardyn_core.physics.cage.drag import CAGE_DRAGS
from beardyn_core.run import start
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.tier import TIERS
from beardyn_core.structure.mounted_box import modes_of_effects, mounting_of
from beardyn_core.twin import Twin

SETTLING_TURNS = 3
STANDARD, FULL = load_effects("standard"), load_effects("all")


def _sets() -> dict[str, EffectSet]:
    """List the effects of each set."""
    found: dict[str, EffectSet] = {"standard": STANDARD}

    def more(name: str, **members: Any) -> None:
        found[f"+ {name}"] = replace(STANDARD, **members)

    for name in STANDARD.names():
        found[f"- {name}"] = replace(STANDARD, **{name: None})
    cage, film, rib = STANDARD.cage, STANDARD.film, STANDARD.rib
    assert isinstance(cage, Cage)
    assert isinstance(film, LineFilm)
    assert isinstance(rib, Rib)
    more("lamina_coupling", lamina_coupling=LaminaCoupling())
    more("traction coulomb, no film", traction=CoulombTraction(), film=None)
    more("traction sheared_film", traction=ShearedFilmTraction())
    more("traction load_sharing", traction=LoadSharingTraction())
    more("film thermal, isoviscous", film=replace(film, thermal="murch_wilson", isoviscous=True))
    more("rolling_resistance", rolling_resistance=RollingResistance())
    more("drag", drag=Drag())
    more("rib lubrication mixed", rib=replace(rib, lubrication=RibMixedFilm()))
    more("rib lubrication sheared_film", rib=replace(rib, lubrication=RibShearedFilm()))
    more("rib roller_end, drilling", rib=replace(rib, roller_end=True, drilling=True))
    more("small_rib", small_rib=SmallRib())
    more("cage rotating", cage=RotatingCage())
    more("cage kinematic", cage=KinematicCage())
    more("cage lubrication", cage=replace(cage, lubrication=PocketFilm()))
    more("cage guidance", cage=replace(cage, guidance=LandGuidance()))
    more("seal", seal=Seal())
    more("structure", structure=RingStructure())
    more("thermal", thermal=Thermal())
    for name in CAGE_DRAGS:
        more(name, **{name: next(entry.options() for entry in catalogue() if entry.member == name)})
    found["full"] = FULL
    return found


def _in_box(scene: Scene) -> Scene:
    """Put the bearing into the box `high_speed`, with all its modes."""
    effects = replace(scene.effects, structure=ModalStructure("high_speed"))
    modes = modes_of_effects(effects)
    assert modes is not None
    mounting = mounting_of(modes, scene.mounting, scene.bearing)
    return replace(scene, effects=effects, mounting=mounting)


def _with_faults(scene: Scene) -> Scene:
    return replace(scene, defects=load_scene("cup_spall", effects="standard").defects)


def _wavy(scene: Scene) -> Scene:
    return replace(scene, waviness=load_scene("waviness", effects="standard").waviness)


def _with_laminae(count: int) -> Callable[[Scene], Scene]:
    return lambda scene: replace(scene, numerics=replace(scene.numerics, laminae=count))


def _in_tier(name: str, laminae: int = 6) -> Callable[[Scene], Scene]:
    def changed(scene: Scene) -> Scene:
        numerics = replace(scene.numerics, steps_per_sample=TIERS[name].steps_per_sample, laminae=laminae)
        return replace(scene, tier=name, numerics=numerics)

    return changed


def _coupled(scene: Scene) -> Scene:
    return replace(scene, effects=replace(scene.effects, lamina_coupling=LaminaCoupling()))


def _without_creep(scene: Scene) -> Scene:
    return replace(scene, effects=replace(scene.effects, traction=None))


CHANGES: dict[str, Callable[[Scene], Scene]] = {
    "+ structure modes": _in_box,
    "+ faults": _with_faults,
    "+ waviness": _wavy,
    "laminae 2": _with_laminae(2),
    "laminae 20": _with_laminae(20),
    "tier lumped": _in_tier("lumped"),
    "tier quasistatic": _in_tier("quasistatic"),
    "tier quasistatic, laminae 20": _in_tier("quasistatic", 20),
    "tier quasistatic, no creep": lambda scene: _in_tier("quasistatic")(_without_creep(scene)),
    "tier quasistatic, coupled": lambda scene: _in_tier("quasistatic")(_coupled(scene)),
    "tier quasistatic, laminae 40": _in_tier("quasistatic", 40),
    "tier quasistatic, coupled, laminae 40": lambda scene: _in_tier("quasistatic", 40)(_coupled(scene)),
    "laminae 40": _with_laminae(40),
    "coupled, laminae 40": lambda scene: _with_laminae(40)(_coupled(scene)),
}


def _ready(scene: Scene, turns: int) -> Twin:
    return start(scene, (turns + SETTLING_TURNS) * Twin.block_ns * 1e-9).twin


def _microseconds(twin: Twin) -> tuple[float, float]:
    """Measure the time of a step in the kernel, and of the rest of the next block, channels included."""
    began = time.perf_counter()
    kernel = twin.advance().wall_s
    rest = time.perf_counter() - began - kernel
    return 1e6 * kernel / (512 * twin.scene.numerics.steps_per_sample), 1e6 * rest


def measure(scene_name: str, turns: int, only: list[str]) -> list[dict[str, float | str]]:
    """Measure the time per step of every set, and its ratio to `standard`."""
    base = load_scene(scene_name, effects="standard")
    scenes = {name: replace(base, effects=effects) for name, effects in _sets().items()}
    scenes |= {name: change(replace(base, effects=STANDARD)) for name, change in CHANGES.items()}
    chosen = [name for name in scenes if not only or name == "standard" or any(o in name for o in only)]
    twins = {name: _ready(scenes[name], turns) for name in chosen}
    times: dict[str, list[float]] = {name: [] for name in chosen}
    rests: dict[str, list[float]] = {name: [] for name in chosen}
    for turn in range(turns + SETTLING_TURNS):
        for name in chosen if turn % 2 else reversed(chosen):
            step, rest = _microseconds(twins[name])
            times[name].append(step)
            rests[name].append(rest)
    rows: list[dict[str, float | str]] = []
    for name in chosen:
        found, reference = times[name][SETTLING_TURNS:], times["standard"][SETTLING_TURNS:]
        ratio = statistics.median(a / b for a, b in zip(found, reference, strict=True))
        rows.append(
            {
                "set": name,
                "us_per_step": statistics.median(found),
                "least_us_per_step": min(found),
                "rest_us_per_block": min(rests[name][SETTLING_TURNS:]),
                "ratio": ratio,
                "least_ratio": min(found) / min(reference),
            }
        )
    return rows


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scene", default="static_80kN")
    parser.add_argument("--turns", type=int, default=30)
    parser.add_argument("--only", nargs="*", default=[], help="words in the names of the sets to measure")
    parser.add_argument("--json")
    parser.add_argument("--write", action="store_true", help=f"update {COST_FILE.name} of the choice room")
    arguments = parser.parse_args()
    rows = measure(arguments.scene, arguments.turns, arguments.only)
    print(f"{platform.processor() or platform.machine()}, one core, {arguments.scene}")
    print("time per step: median and least; ratio to standard: median over turns, and of the least")
    print(f"{'set':32}{'us/step':>9}{'least':>9}{'ratio':>9}{'least':>9}")
    for row in rows:
        print(
            f"{row['set']:32}{row['us_per_step']:>9.2f}{row['least_us_per_step']:>9.2f}"
            f"{row['ratio']:>9.3f}{row['least_ratio']:>9.3f}"
        )
    if arguments.json:
        with open(arguments.json, "w", encoding="utf-8") as file:
            json.dump(rows, file, indent=1)
    if arguments.write:
        write_costs(COST_FILE, arguments, rows)


def write_costs(path: Path, arguments: argparse.Namespace, rows: list[dict[str, float | str]]) -> None:
    """Update the shipped cost file with measured ratios."""
    # the least of many turns: what others on the machine do only adds
    measured = {str(row["set"]): round(float(row["least_ratio"]), 4) for row in rows}
    before = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
    tiers = {"standard": "full", "tier lumped": "lumped", "tier quasistatic": "quasistatic"}
    rests = {
        tiers[name]: round(float(row["rest_us_per_block"]), 1)
        for row in rows
        if (name := str(row["set"])) in tiers
    }
    content = {
        "about": "kernel time of a step over that of the standard set, full tier, 6 laminae; time of a block "
        "outside of the kernel; written by `python benchmarks/effect_costs.py --write`",
        "machine": _machine(),
        "date": datetime.date.today().isoformat(),
        "versions": {name: version(name) for name in ("numba", "numpy")},
        "scene": arguments.scene,
        "turns": arguments.turns,
        "standard_us_per_step": round(float(rows[0]["least_us_per_step"]), 2),
        "rest_us_per_block": before.get("rest_us_per_block", {}) | rests,
        "ratios": before.get("ratios", {}) | measured,
    }
    path.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


def _machine() -> str:
    names = (
        line.split(":", 1)[1].strip()
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        if line.startswith("model name")
    )
    return next(names, platform.machine())


if __name__ == "__main__":
    main()
