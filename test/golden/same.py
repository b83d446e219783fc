"""The harness for moves and renames: a commit gives the same bits as another one, or says where not.

::

    make same                 # the working tree against the last commit
    make same BASE=main~5     # against any commit that has this file

Each commit digests itself with its own copy of this file, on the same machine: digests depend on processor
and compiler and are not kept in the repository. Compared are, by name, every array of every block and the
state at the end of short runs (`RUNS`), the encoded messages, every shipped noun and every JSON schema.
"""

from __future__ import annotations

import argparse
import dataclasses
import hashlib
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from beardyn_core.choice import load_scene, load_trial
from beardyn_core.config import (
    SCHEMA_KINDS,
    json_schema,
    load_any_bearing,
    load_box,
    load_effects,
    load_lubricant,
    load_vehicle,
    read_scene,
    shipped_names,
)
from beardyn_core.config.folders import find
from beardyn_core.config.yaml_text import read_file
from beardyn_core.experiments import Cluster, Engine
from beardyn_core.rail.build import load_history
from beardyn_core.record.encoding import BlockEncoder
from beardyn_core.sensors.block import Block
from beardyn_core.twin import Twin

BLOCKS = 5
TIERS = ("full", "quasistatic", "lumped")
# Scenes in every tier with their own effects, or the standard ones.
SCENES = (
    "brinelling",
    "cone_spall",
    "cup_spall",
    "dent_on_cone",
    "growing_spall",
    "light_coasting",
    "oversize_roller",
    "reversing",
    "roller_spall",
    "stop_and_start",
    "waviness",
    "wheel_flat",
)
# One scene with every preset, and rooms that no shipped scene enters.
PRESETS = ("dry", "frictionless", "all")
WORDS = {
    "one row": "rows: 1\nmounting: {axial_prop_stiffness_MN_per_m: 100, journal_tilt: locked, cup: held}\n",
    "hot": "effects: {preset: all, thermal: {time_scale: 1000}, cage: {lubrication: true, guidance: {}}}\n",
    "kinematic": "effects: {preset: standard, cage: {kind: rotating}, traction: {kind: coulomb}}\n",
    "missing": "missing_rollers: [{row: 0, roller: 3}]\n",
    "suspended": "mounting: {cup: suspended, journal_tilt: free}\nnumerics: {laminae: 20}\n",
}
COMMON = """\
scene: same
bearing: HS130x230
lubricant: L055
operation: {kind: constant, force_kN: [2, 3, 40], speed_rpm: 900}
"""


def _runs() -> list[tuple[str, str, str, str]]:
    """Name, scene (a shipped name, or words of a scene file), tier and preset of every run."""
    found = [(f"{scene}, {tier}", scene, tier, "") for scene in SCENES for tier in TIERS]
    found += [
        (f"static_80kN {preset}, {tier}", "static_80kN", tier, preset) for preset in PRESETS for tier in TIERS
    ]
    written = {name: COMMON + words for name, words in WORDS.items()}
    found += [(f"{name}, {tier}", text, tier, "") for name, text in written.items() for tier in TIERS]
    return found


RUNS = _runs()


def digest(*parts: bytes) -> str:
    """Shorten bytes to sixteen letters."""
    total = hashlib.sha256()
    for part in parts:
        total.update(part)
    return total.hexdigest()[:16]


def digests_of_run(run: tuple[str, str, str, str]) -> dict[str, str]:
    """Simulate a scene for five blocks and digest all that comes out.

    Parameters
    ----------
    run : tuple
        One of `RUNS`.

    Returns
    -------
    dict
        Digest by run and array; a refused scene gives its sentence.
    """
    name, scene, tier, preset = run
    with tempfile.TemporaryDirectory() as folder:
        if "\n" in scene:
            path = Path(folder) / "same.yaml"
            path.write_text(scene, encoding="utf-8")
            scene = str(path)
        try:
            return {f"{name}: {key}": value for key, value in _simulated(scene, tier, preset)}
        except Exception as error:  # a run that cannot be is compared by what it says
            words = str(error).replace(folder, "")
            return {f"{name}: {type(error).__name__}": words}


def _named(name: str) -> Any:
    """Name the standard effects where a scene leaves them open: choices may change, kernels must not."""
    written = read_file(find("scenes", name)).get("effects", "auto")
    if isinstance(written, dict) and written.get("preset") == "auto":
        return {**written, "preset": "standard"}
    return "standard" if written == "auto" else None


def _simulated(name: str, tier: str, preset: str) -> Iterator[tuple[str, str]]:
    scene = load_scene(name, tier=tier, effects=preset or _named(name))
    twin = Twin(scene)
    twin.start(load_history(scene.operation, scene.mounting, 0.5, scene.seed))
    blocks: list[Block] = [twin.advance() for _ in range(BLOCKS)]
    for key in sorted(blocks[0].arrays()):
        yield f"array {key}", digest(*(_bytes_of(block.arrays()[key]) for block in blocks))
    yield "audit and status", digest(repr([(block.audit, block.status) for block in blocks]).encode())
    state = twin.snapshot().state
    for part, value in state._asdict().items():
        yield f"state {part}", digest(_bytes_of(value))
    names = tuple(f"vibration_{k}" for k in range(len(scene.sensors)))
    encoder = BlockEncoder(scene.bearing.roller_count, names, "axlebox")
    messages: dict[str, list[bytes]] = {}
    for block in blocks:
        for topic, stamp, cdr in encoder.encode(block):
            messages.setdefault(topic, []).append(f"{stamp}".encode() + bytes(cdr))
    for topic, parts in sorted(messages.items()):
        yield f"topic {topic}", digest(*parts)


def _bytes_of(value: Any) -> bytes:
    """Bytes of a state: an array, or arrays under names."""
    if isinstance(value, np.ndarray):
        return np.ascontiguousarray(value).tobytes()
    if dataclasses.is_dataclass(value):
        return b"".join(_bytes_of(getattr(value, field.name)) for field in dataclasses.fields(value))
    if isinstance(value, tuple | list):
        return b"".join(_bytes_of(each) for each in value)
    return repr(value).encode()


def digests_of_nouns() -> dict[str, str]:
    """Digest every shipped file as the noun it becomes, and every schema."""
    kinds: dict[str, Callable[[str], Any]] = {
        "bearings": load_any_bearing,
        "effects": load_effects,
        "lubricants": load_lubricant,
        "scenes": lambda name: read_scene(name).scene,
        "trials": load_trial,
        "vehicles": load_vehicle,
        "structures": load_box,
    }
    found = {
        f"{kind} {name}": digest(_canonical(load(name)).encode())
        for kind, load in kinds.items()
        for name in shipped_names(kind)
    }
    found |= {f"schema {kind}": digest(json.dumps(json_schema(kind)).encode()) for kind in SCHEMA_KINDS}
    return found


def _canonical(value: Any) -> str:
    """Everything in a noun under its name, floats to the bit, without the text it was read from."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        inner = {
            field.name: _canonical(getattr(value, field.name))
            for field in dataclasses.fields(value)
            if field.name != "source_text"
        }
        return f"{type(value).__name__}{sorted(inner.items())}"
    if isinstance(value, float):
        return value.hex()
    if isinstance(value, np.ndarray):
        return f"{value.shape}{digest(value.tobytes())}"
    if isinstance(value, tuple | list):
        return f"[{', '.join(map(_canonical, value))}]"
    if isinstance(value, dict):
        return f"{sorted((str(key), _canonical(each)) for key, each in value.items())}"
    return repr(value)


def digests_here(only: str, jobs: int) -> dict[str, str]:
    """Digest the tree that this file was imported from.

    Parameters
    ----------
    only : str
        Text that the name of a run, file or schema must have; all when empty.
    jobs : int
        Processes.
    """
    found = {key: value for key, value in digests_of_nouns().items() if only in key}
    runs = [run for run in RUNS if only in run[0]]
    with Engine(Cluster(workers=jobs)) as engine:
        for ended in engine.run(digests_of_run, runs):
            if ended.killed:
                raise SystemExit(f"{ended.task}: {ended.killed} processes died of it")
            found |= ended.value
            print(".", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    return found


def digests_of_commit(commit: str, only: str, jobs: int) -> dict[str, str]:
    """Check a commit out beside the tree and let it digest itself."""
    root = Path(__file__).resolve().parents[2]
    with tempfile.TemporaryDirectory() as folder:
        tree = Path(folder) / "base"
        subprocess.run(
            ["git", "-C", str(root), "worktree", "add", "--quiet", "--detach", str(tree), commit], check=True
        )
        try:
            return digests_in(tree, only, jobs)
        finally:
            subprocess.run(["git", "-C", str(root), "worktree", "remove", "--force", str(tree)], check=True)


def digests_in(tree: Path, only: str, jobs: int) -> dict[str, str]:
    """Let a tree digest itself in a process of its own."""
    if not (tree / "test" / "golden" / "same.py").is_file():
        raise SystemExit(f"{tree}: this commit has no test/golden/same.py, so it cannot be compared")
    command = [sys.executable, "-m", "test.golden.same", "--digests", "--only", only, "--jobs", str(jobs)]
    environment = {**os.environ, "PYTHONPATH": str(tree)}
    done = subprocess.run(command, cwd=tree, env=environment, stdout=subprocess.PIPE, text=True)
    if done.returncode:
        raise SystemExit(f"{tree}: the digests could not be made, see above")
    return dict(json.loads(done.stdout))


def compare(before: dict[str, str], after: dict[str, str]) -> list[str]:
    """Name what differs, what is gone and what is new."""
    differing = [f"differs  {key}" for key in before if key in after and before[key] != after[key]]
    gone = [f"gone     {key}" for key in before if key not in after]
    new = [f"new      {key}" for key in after if key not in before]
    return differing + gone + new


def main() -> int:
    """Compare the working tree with a commit."""
    parser = argparse.ArgumentParser(prog="make same", description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("base", nargs="?", default="HEAD", help="commit to compare with (default HEAD)")
    parser.add_argument(
        "--only", default="", metavar="TEXT", help="runs, files and schemas whose name has this text"
    )
    parser.add_argument("--jobs", type=int, default=2, help="processes (default 2)")
    parser.add_argument("--save", type=Path, help="write the digests of the working tree to this file")
    parser.add_argument("--against", type=Path, help="compare with digests saved earlier, not with a commit")
    parser.add_argument("--digests", action="store_true", help="print the digests and compare nothing")
    asked = parser.parse_args()
    after = digests_here(asked.only, asked.jobs)
    if asked.only and not after:
        parser.error(f"--only {asked.only}: nothing that is compared has this text in its name")
    if asked.digests:
        print(json.dumps(after))
        return 0
    if asked.save:
        asked.save.write_text(json.dumps(after, indent=0), encoding="utf-8")
        print(f"{len(after)} digests in {asked.save}")
        return 0
    if asked.against:
        kept: dict[str, str] = json.loads(asked.against.read_text(encoding="utf-8"))
        before = {key: value for key, value in kept.items() if asked.only in key}
    else:
        before = digests_of_commit(asked.base, asked.only, asked.jobs)
    found = compare(before, after)
    print("\n".join(found) if found else f"the same: {len(after)} digests, to the bit")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
