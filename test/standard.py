"""The standard effects where a scene names none: what most tests are about, with kernels that are compiled.

A scene that names no effects is computed with those that `auto` chooses, which differ from scene to scene,
and so do their kernels. Tests of something else take the standard set: scenes of their own because they are
read so in this process, shipped ones because they stand so in a copy of the configuration, which nodes and
commands in other processes read as well. A test of what the scenes are really computed with takes the fixture
``shipped_configuration``.
"""

from __future__ import annotations

import os
import re
import shutil
from pathlib import Path

SHIPPED = Path(__file__).resolve().parents[1] / "config"
NAME = "standard"
_AUTO = re.compile(r"^(effects|  preset): auto\b", re.MULTILINE)


def name_effects(text: str) -> str:
    """Write the name of the standard set into a scene's text where the effects are open."""
    named = _AUTO.sub(rf"\1: {NAME}", text)
    return named if re.search(r"^effects:", named, re.MULTILINE) else f"{named}\neffects: {NAME}\n"


def write_configuration(folder: Path) -> Path:
    """Copy the shipped configuration with effects named in every scene; what is the same stays untouched."""
    for source in sorted(SHIPPED.rglob("*")):
        if not source.is_file():
            continue
        target = folder / source.relative_to(SHIPPED)
        content = source.read_bytes()
        if source.parent.name == "scenes" and source.suffix == ".yaml":
            content = name_effects(content.decode()).encode()
        if not target.is_file() or target.read_bytes() != content:
            target.parent.mkdir(parents=True, exist_ok=True)
            fresh = target.with_name(f".{target.name}.{os.getpid()}")
            fresh.write_bytes(content)
            shutil.copystat(source, fresh)
            fresh.replace(target)
    for extra in folder.rglob("*.*"):
        if not (SHIPPED / extra.relative_to(folder)).exists() and not extra.name.startswith("."):
            extra.unlink(missing_ok=True)
    return folder
