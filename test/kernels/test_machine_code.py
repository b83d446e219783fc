"""Compiled kernels are found again after edits that cannot reach them, and after no other."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable, Iterator
from enum import IntFlag
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

from beardyn_core.base.jit import _whole, plain
from beardyn_core.base.machine_code import _Reader
from beardyn_core.physics.film import asperity_share
from test.forks import Forks

CORE = Path(__file__).resolve().parents[2] / "beardyn_core"
# the step of the full tier: what it comes from, and the types of all that it may be called with
DIGEST = """
import json, sys
from beardyn_core.physics.tiers.imex import advance
from beardyn_core.base.machine_code import code_digest
print(json.dumps(code_digest(advance.py_func)))
"""
SMALL = {
    "__init__.py": "",
    "../other/__init__.py": "",
    "../other/layout.py": "FIRST = 0\n",
    "layout.py": '"""Where numbers stand."""\nTHIRD = 2\nBUILT = 5\n',
    "deep/__init__.py": "",
    "deep/tuples/__init__.py": "",
    "deep/tuples/ribs.py": "from typing import NamedTuple\n\n\nclass Rib(NamedTuple):\n    stiffness: float\n"
    "    play: float\n\n\ndef build(scene):\n    return Rib(1e8 * scene, 1e-5)\n",
    "deep/force.py": "from beardyn_core.base.jit import inline\n\n_SMALLEST = 1e-15\n\n\n@inline\n"
    'def force(rib, gap):\n    """Give the force."""\n'
    "    # against the way\n    return rib.stiffness * max(gap - rib.play, _SMALLEST)\n",
    "step.py": "from beardyn_core.base.jit import entry\nfrom other import layout as far\n"
    "from small import layout\n"
    'from small.deep.force import force\n\n\n@entry\ndef step(state, rib):\n    """Advance."""\n'
    "    state[layout.THIRD] += force(rib, state[far.FIRST])\n    return state[layout.THIRD]\n",
    "run.py": "import json\n\nimport numpy as np\n\nfrom small.deep.tuples.ribs import build\n"
    "from small.step import step\nfrom beardyn_core.base.jit import when_compiling\n\n"
    "with when_compiling(lambda: None) as compiled:\n"
    "    found = step(np.array([1e-3, 0.0, 1.0, 0.0]), build(1.0))\n"
    "print(json.dumps([bool(compiled), float(found)]))\n",
}


class Small:
    """A small package with kernels of its own, and a cache of its own."""

    def __init__(self, folder: Path, forks: Forks) -> None:
        self._folder, self._forks = folder, forks
        for name, text in SMALL.items():
            path = folder / "small" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)

    def run(self) -> tuple[Any, ...]:
        """Tell whether anything was compiled, and give the number that came out."""
        printed = self._forks.run(
            "import small.run",
            self._folder,
            (self._folder, CORE.parent),
            {"BEARDYN_CACHE_DIR": str(self._folder / "cache")},
        )
        compiled, value = json.loads(printed)
        return compiled, value

    def edit(self, name: str, old: str, new: str) -> None:
        path = self._folder / "small" / name
        text = path.read_text()
        assert old in text
        path.write_text(text.replace(old, new))

    def move(self, old: str, new: str) -> None:
        (self._folder / "small" / new).parent.mkdir(exist_ok=True)
        shutil.move(self._folder / "small" / old, self._folder / "small" / new)

    @property
    def files(self) -> list[Path]:
        return sorted((self._folder / "cache" / "kernels").iterdir())


@pytest.fixture(scope="module")
def forks() -> Iterator[Forks]:
    with Forks("numba") as found:
        yield found


@pytest.fixture(scope="module")
def compiled(tmp_path_factory: pytest.TempPathFactory, forks: Forks) -> Path:
    folder = tmp_path_factory.mktemp("compiled")
    assert Small(folder, forks).run() == (True, pytest.approx(1.0 + 1e8 * (1e-3 - 1e-5)))
    return folder


@pytest.fixture
def small(compiled: Path, tmp_path: Path, forks: Forks) -> Small:
    shutil.copytree(compiled, tmp_path / "copy")
    found = Small(tmp_path / "copy", forks)
    assert not found.run()[0]  # nor does it matter where it lies
    return found


def _moved_kernels(small: Small) -> None:
    small.move("deep/force.py", "deep/pressing.py")
    small.edit("step.py", "small.deep.force", "small.deep.pressing")


def _moved_tuples(small: Small) -> None:
    small.move("deep/tuples/ribs.py", "deep/ribs.py")
    small.edit("run.py", "small.deep.tuples.ribs", "small.deep.ribs")


def _moved_entry(small: Small) -> None:
    small.move("step.py", "deep/advance.py")
    small.edit("run.py", "small.step", "small.deep.advance")


def _split(small: Small) -> None:
    small.move("layout.py", "numbers.py")
    small.edit("step.py", "small import layout", "small import numbers as layout")


@pytest.mark.parametrize(
    "change",
    [
        pytest.param(lambda small: small.edit("step.py", "Advance.", "Go on."), id="docstring of an entry"),
        pytest.param(
            lambda small: small.edit("step.py", "\n\n\n@", "\n\n# here\n\n\n@"), id="place of an entry"
        ),
        pytest.param(lambda small: small.edit("deep/force.py", "Give the", "Find the"), id="docstring"),
        pytest.param(lambda small: small.edit("deep/force.py", "# against the way", "# back"), id="comment"),
        pytest.param(
            lambda small: small.edit("deep/force.py", '"""Give the force."""\n', ""), id="no docstring"
        ),
        pytest.param(
            lambda small: small.edit("deep/tuples/ribs.py", "return Rib(", "return Rib(1.0 * "), id="builder"
        ),
        pytest.param(
            lambda small: small.edit("layout.py", "BUILT = 5", "BUILT = 6"), id="layout of builders"
        ),
        pytest.param(_moved_kernels, id="kernels moved"),
        pytest.param(_moved_tuples, id="tuples moved"),
        pytest.param(_moved_entry, id="entry moved"),
        pytest.param(_split, id="layout moved"),
        pytest.param(
            lambda small: small.edit(
                "run.py",
                "with when",
                "from beardyn_core.base.interrupts import whole\n\nwith whole(), when",
            ),
            id="state of the program",
        ),
    ],
)
def test_what_cannot_reach_machine_code_keeps_it(small: Small, change: Callable[[Small], None]) -> None:
    change(small)
    assert small.run() == (False, pytest.approx(1.0 + 1e8 * (1e-3 - 1e-5)))


@pytest.mark.parametrize(
    ("name", "old", "new", "value"),
    [
        pytest.param("deep/force.py", "gap - rib.play", "gap + rib.play", 1.0 + 1e8 * 1.01e-3, id="formula"),
        pytest.param("deep/force.py", "1e-15", "2e-3", 1.0 + 1e8 * 2e-3, id="constant"),
        pytest.param("layout.py", "THIRD = 2", "THIRD = 1", 1e8 * (1e-3 - 1e-5), id="layout"),
        pytest.param(
            *("../other/layout.py", "FIRST = 0", "FIRST = 2", 1.0 + 1e8 * (1.0 - 1e-5)),
            id="layout of another package",
        ),
        pytest.param(
            *(
                "deep/tuples/ribs.py",
                "    stiffness: float\n    play: float",
                "    play: float\n    stiffness: float",
            ),
            1.0 + 1e-5 * max(1e-3 - 1e8, 1e-15),
            id="order of a tuple",
        ),
        pytest.param(
            *("deep/tuples/ribs.py", "play: float\n", "play: float\n    wear: float = 0.0\n"),
            1.0 + 1e8 * (1e-3 - 1e-5),
            id="field of a tuple",
        ),
        pytest.param(
            *("step.py", "state[far.FIRST])", "state[far.FIRST] + 1e-3)"),
            1.0 + 1e8 * (2e-3 - 1e-5),
            id="entry",
        ),
    ],
)
def test_what_reaches_machine_code_compiles_it_anew(
    small: Small, name: str, old: str, new: str, value: float
) -> None:
    small.edit(name, old, new)
    assert small.run() == (True, pytest.approx(value))
    assert not small.run()[0]


@pytest.mark.parametrize("left", [0, 40, -1])
def test_a_file_that_is_cut_counts_as_none_and_is_written_again(small: Small, left: int) -> None:
    (path,) = small.files
    path.write_bytes(path.read_bytes()[:left])
    assert small.run()[0]
    assert not small.run()[0]


def test_a_folder_that_cannot_be_written_keeps_nothing(small: Small, tmp_path: Path) -> None:
    shutil.rmtree(tmp_path / "copy" / "cache")
    (tmp_path / "copy" / "cache").write_text("a file is in the way")
    assert small.run()[0]


def test_fields_of_a_constant_tuple_and_combined_flags_count() -> None:
    class Here(NamedTuple):
        a: int
        b: int

    class There(NamedTuple):
        b: int
        a: int

    spelled = _Reader().value
    assert spelled(Here(0, 1)).replace("Here", "There") != spelled(There(0, 1))

    class One(IntFlag):
        A, B, BOTH = 1, 2, 3

    class Other(IntFlag):
        A, B, BOTH = 1, 2, 7

    assert spelled(One).replace("One", "Other") != spelled(Other)


def test_a_choice_asks_the_kernels_formulas_without_compiling() -> None:
    before = _whole.cache_info().currsize
    share = plain(asperity_share)(0.5)
    assert share == pytest.approx(np.exp(-1.8 * 2.0 ** (1.2 * 0.5)), rel=1e-9)
    assert _whole.cache_info().currsize == before


# --- the step of the full tier ---------------------------------------------------------------------


class Copied:
    """A copy of the package, in which one thing is edited at a time."""

    def __init__(self, folder: Path, forks: Forks) -> None:
        self._folder, self._forks = folder, forks
        shutil.copytree(CORE, folder / CORE.name, ignore=shutil.ignore_patterns("__pycache__"))
        self.digest = self._digest()

    def digest_after(self, name: str, old: str, new: str) -> str:
        """Digest of `advance` with one edit."""
        path = self._folder / CORE.name / name
        text = path.read_text()
        assert old in text
        path.write_text(text.replace(old, new, 1))
        try:
            return self._digest()
        finally:
            path.write_text(text)

    def _digest(self) -> str:
        return str(json.loads(self._forks.run(DIGEST, self._folder, (self._folder,))))


@pytest.fixture(scope="module")
def copied(tmp_path_factory: pytest.TempPathFactory, forks: Forks) -> Copied:
    return Copied(tmp_path_factory.mktemp("copied"), forks)


@pytest.mark.parametrize(
    ("name", "old", "new", "changes"),
    [
        ("physics/cage/walls.py", "0.5 * cage.stiffness * inside", "0.6 * cage.stiffness * inside", True),
        ("physics/cage/walls.py", "_SMALLEST_WAY = 1e-15", "_SMALLEST_WAY = 1e-14", True),
        ("physics/bodies/layout.py", "\nREACTION = ", "\nREACTION = 0 + 1 + ", True),
        ("physics/lanes/lanes.py", "builder.fadd(a, b", "builder.fadd(b, a", True),  # told to numba by hand
        ("base/jit.py", '"forceinline": True', '"forceinline": False', True),
        ("physics/bodies/layout.py", "# --- where energy is lost", "# --- where energy goes", False),
        ("physics/cage/pocket.py", '"""', '"""Anew: ', False),
        ("physics/rib.py", "return ", "return 1.0 * ", False),
    ],
)
def test_the_step_of_the_full_tier_follows_what_reaches_it(
    copied: Copied, name: str, old: str, new: str, changes: bool
) -> None:
    assert (copied.digest_after(name, old, new) != copied.digest) is changes
