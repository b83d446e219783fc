"""The folder of a compiled kernel follows every source the kernel may come from, and no other."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from beardyn_core import jit


@pytest.fixture
def hash_after(tmp_path, monkeypatch):
    """Hash of an entry's file in a copy of the package, after a file of the copy is changed."""
    core = tmp_path / "beardyn_core"
    shutil.copytree(Path(jit.__file__).parent, core, ignore=shutil.ignore_patterns("__pycache__"))
    monkeypatch.setattr(jit, "_CORE", core)

    def forget():
        for remembered in (jit.source_hash, jit._sources, jit._text, jit._imported):
            remembered.cache_clear()

    def changed(entry: str, edited: str | None, old: str = "", new: str = "# changed\n") -> str:
        if edited is not None:
            text = (core / edited).read_text()
            assert old in text
            (core / edited).write_text(text.replace(old, new) if old else text + new)
        forget()
        return jit.source_hash(core / entry)

    yield changed
    forget()


@pytest.mark.parametrize(
    "edited",
    [
        "integrate/imex.py",
        "kernels/lane_math.py",  # imported by what it imports
        "model/layout.py",  # imported as a module
        "jit.py",
    ],
)
def test_an_edit_that_the_kernel_may_come_from_changes_the_folder(hash_after, edited):
    assert hash_after("integrate/imex.py", None) != hash_after("integrate/imex.py", edited)


@pytest.mark.parametrize(
    ("edited", "old", "new"),
    [
        ("model/tier_parameters.py", "rate: float", "speed: float"),
        ("model/ribs.py", "class RibEndParams(NamedTuple)", "class RimParams(NamedTuple)"),
        ("integrate/state.py", "    signals: Any", "    step_signals: Any"),
    ],
)
def test_another_named_tuple_that_it_may_be_compiled_for_changes_the_folder(hash_after, edited, old, new):
    assert hash_after("integrate/imex.py", None) != hash_after("integrate/imex.py", edited, old, new)


@pytest.mark.parametrize(
    "edited",
    [
        "rail/vehicle.py",
        "twin.py",
        "observe/block.py",
        "integrate/lumped.py",
        "model/tier_parameters.py",  # what fills the named tuples, below their definitions
        "model/ribs.py",
        "scene/scene.py",
        "bearing/geometry.py",
        "effects/rib.py",
    ],
)
def test_an_edit_elsewhere_keeps_the_folder(hash_after, edited):
    assert hash_after("integrate/imex.py", None) == hash_after("integrate/imex.py", edited)


@pytest.mark.parametrize(
    ("statement", "changes"),
    [
        ("from beardyn_core.rail import vehicle", True),
        ("from beardyn_core.rail import spectra, vehicle", True),
        ("from beardyn_core.rail import spectra", False),
        ("from beardyn_core.rail import no_module", True),  # a name of the room may come from anywhere in it
        ("from beardyn_core.rail import (\n    spectra,\n)", True),
    ],
)
def test_of_a_room_the_modules_count_that_are_imported_by_name(hash_after, statement, changes):
    before = hash_after("integrate/imex.py", "integrate/imex.py", new=f"{statement}\n")
    assert (hash_after("integrate/imex.py", "rail/vehicle.py") != before) is changes
