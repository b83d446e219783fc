"""What the build backend puts into a wheel beside the package, with what it starts replaced."""

from __future__ import annotations

import importlib.util
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

ROOT = Path(__file__).parents[2]


@pytest.fixture
def backend(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """The backend, with a folder in place of the package's; a wheel is a list of what is shipped in it."""
    spec = importlib.util.spec_from_file_location("backend", ROOT / "release" / "build_backend.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    shipped = tmp_path / "shipped"
    monkeypatch.setattr(module, "SHIPPED", shipped)
    monkeypatch.setattr(module.platform, "machine", lambda: "x86_64")

    def build(*_arguments: Any) -> str:
        return " ".join(sorted(path.name for path in shipped.rglob("*") if path.is_file()))

    monkeypatch.setattr(module.build_meta, "build_wheel", build)
    return module


def runs(failing: str = "") -> Callable[[str, Path, dict[str, str]], str]:
    """Leave in the cache what a task leaves there, unless it fails."""

    def run(task: str, cache: Path, environment: dict[str, str]) -> str:
        name = environment.get("NUMBA_CPU_NAME", task)
        if name == failing:
            return "it failed"
        folder = cache / ("choices" if task == "choose" else "kernels")
        folder.mkdir(parents=True)
        (folder / name).write_text("")
        return ""

    return run


@pytest.mark.parametrize(
    ("failing", "settings", "inside"),
    [
        ("", None, "choose x86-64-v3 x86-64-v4"),
        ("x86-64-v4", None, "choose x86-64-v3"),
        ("choose", None, "x86-64-v3 x86-64-v4"),
        ("", {"kernels": "no"}, ""),
    ],
)
def test_what_failed_is_left_out_and_the_wheel_is_built(
    backend: ModuleType,
    failing: str,
    settings: dict[str, str] | None,
    inside: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    backend.SHIPPED.mkdir()
    (backend.SHIPPED / "of_earlier_sources").write_text("")
    monkeypatch.setattr(backend, "_run", runs(failing))
    assert backend.build_wheel("", settings) == inside
    assert not backend.SHIPPED.exists()  # a source distribution has none
    assert ("it failed" in capsys.readouterr().out) == bool(failing)


def test_only_a_wheel_with_kernels_needs_what_running_them_needs(
    backend: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(backend.build_meta, "get_requires_for_build_wheel", lambda _settings: ["wheel"])
    needed = backend.get_requires_for_build_wheel()
    assert any(each.startswith("numba") for each in needed)
    assert backend.get_requires_for_build_wheel({"kernels": "no"}) == ["wheel"]
