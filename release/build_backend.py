"""Build backend: that of setuptools, and what the default scene needs inside of a wheel.

Its effects are chosen and its kernels compiled here, for two levels of x86-64, so that a first run begins at
once. ``pip install . -C kernels=no`` leaves them out, and so does a machine that cannot compile them.
"""

from __future__ import annotations

import os
import platform
import runpy
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from setuptools import build_meta
from setuptools.build_meta import (
    build_editable,
    build_sdist,
    get_requires_for_build_editable,
    get_requires_for_build_sdist,
    prepare_metadata_for_build_editable,
    prepare_metadata_for_build_wheel,
)

__all__ = [
    "build_editable",
    "build_sdist",
    "build_wheel",
    "get_requires_for_build_editable",
    "get_requires_for_build_sdist",
    "get_requires_for_build_wheel",
    "prepare_metadata_for_build_editable",
    "prepare_metadata_for_build_wheel",
]

ROOT = Path(__file__).parents[1]
SHIPPED = ROOT / "beardyn_core" / "shipped"
Settings = dict[str, Any] | None


def get_requires_for_build_wheel(config_settings: Settings = None) -> list[str]:
    """List what building a wheel needs: to compile kernels, all that running them needs."""
    needed = build_meta.get_requires_for_build_wheel(config_settings)
    return (
        [*needed, *runpy.run_path(str(ROOT / "setup.py"))["INSTALL"]] if _wanted(config_settings) else needed
    )


def build_wheel(
    wheel_directory: str, config_settings: Settings = None, metadata_directory: str | None = None
) -> str:
    """Build a wheel with the kernels of the present sources and no others."""
    # what an earlier build has left would go into the wheel, too
    for left in (SHIPPED, *ROOT.glob("build/lib*/beardyn_core/shipped")):
        shutil.rmtree(left, ignore_errors=True)
    try:
        if _wanted(config_settings) and find_spec("numba"):
            with tempfile.TemporaryDirectory() as folder:
                ship(Path(folder))
        return build_meta.build_wheel(wheel_directory, config_settings, metadata_directory)
    finally:
        shutil.rmtree(SHIPPED, ignore_errors=True)


def _wanted(settings: Settings) -> bool:
    return (settings or {}).get("kernels") != "no" and platform.machine() in ("x86_64", "AMD64")


def ship(folder: Path) -> None:
    """Choose effects, then compile for all levels side by side; a failure is told and leaves out its part."""
    failure = _run("choose", folder, {})
    _copy(folder / "choices", SHIPPED / "choices")
    print(f"effects of the default scene: {failure or 'chosen'}", flush=True)
    named = runpy.run_path(str(ROOT / "beardyn_core" / "base" / "shipped_kernels.py"))
    levels, told = list(named["LEVELS"]), named["told_to_numba"]
    for level in levels:
        _copy(folder / "choices", folder / level / "choices")
    with ThreadPoolExecutor() as pool:
        failures = pool.map(lambda level: _run("compile", folder / level, told(level)), levels)
        for level, failure in zip(levels, failures, strict=True):
            _copy(folder / level / "kernels", SHIPPED / "kernels")
            print(f"kernels for {level}: {failure or 'compiled'}", flush=True)


def _copy(source: Path, target: Path) -> None:
    if source.is_dir():
        shutil.copytree(source, target, dirs_exist_ok=True)


def _run(task: str, cache: Path, environment: dict[str, str]) -> str:
    """Run a task of `compile_kernels` with a cache of its own; says how it failed."""
    path = os.pathsep.join(filter(None, (str(ROOT), os.environ.get("PYTHONPATH"))))
    inherited = {name: value for name, value in os.environ.items() if not name.startswith("NUMBA_")}
    done = subprocess.run(
        [sys.executable, str(ROOT / "release" / "compile_kernels.py"), task],
        env={**inherited, **environment, "BEARDYN_CACHE_DIR": str(cache), "PYTHONPATH": path},
        text=True,
        capture_output=True,
        check=False,
    )
    return f"failed, the first run does it\n{done.stderr}" if done.returncode else ""
