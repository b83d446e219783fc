"""Modes in a Universal file are those of the box that wrote them, in whatever axes and unit."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.cli import main as command
from beardyn_core.config import load_bearing
from beardyn_core.config.nouns import load_box
from beardyn_core.structure.box import Seat
from beardyn_core.structure.damping import DampingTable
from beardyn_core.structure.imported import ModeFile, modes_of_file
from beardyn_core.structure.mesh import row_places
from beardyn_core.structure.table import read_table

pyuff = pytest.importorskip("pyuff")

BEARING = load_bearing("HS130x230")
RADIUS = BEARING.cup_radius
TOP = Seat("top", (0.0, 0.0, 0.17), 0.005)
# of the file seen from the axlebox frame: forward is its z, left its x, up its y
TURN = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
ORIGIN = np.array([0.5, -0.2, 0.1])
HERTZ = (0.0, 0.0, 1500.0, 2600.0)
MODAL_MASS = 4.0


def nodes() -> np.ndarray:
    angle = np.arange(24) * np.pi / 12.0
    rings = [
        np.stack([RADIUS * np.sin(angle), np.full(24, place + shift), RADIUS * np.cos(angle)], axis=1)
        for place in row_places(BEARING)
        for shift in (-0.01, 0.01)
    ]
    return np.concatenate([*rings, [TOP.position]])


def shapes() -> np.ndarray:
    """Two rigid motions, an oval of the cup that the top follows, and three waves on the outboard row."""
    at = nodes()
    angle = np.arctan2(at[:, 0], at[:, 2])
    outward = np.stack([np.sin(angle), np.zeros_like(angle), np.cos(angle)], axis=1)
    along = np.stack([np.cos(angle), np.zeros_like(angle), -np.sin(angle)], axis=1)
    oval = np.cos(2 * angle)[:, None] * outward - 0.5 * np.sin(2 * angle)[:, None] * along
    oval[-1] = (0.0, 0.0, 1.5)
    outboard = (at[:, 1] > 0.0)[:, None]
    waves = outboard * (np.sin(3 * angle)[:, None] * outward + [0.0, 0.25, 0.0])
    waves[-1] = 0.0
    ones = np.ones(len(at))
    return np.stack([np.outer(ones, (1.0, 0.0, 0.0)), np.outer(ones, (0.0, 0.0, 1.0)), oval, waves])


def write(path: Path, unit: float = 1e3, *, kinds: tuple[int, ...] = (15, 55)) -> None:
    at = unit * (nodes() @ TURN + ORIGIN)
    number = np.arange(1, len(at) + 1)
    sets = []
    if 15 in kinds:
        zero = np.zeros(len(at), int)
        sets.append(
            pyuff.prepare_15(
                node_nums=number, def_cs=zero, disp_cs=zero, color=zero, x=at[:, 0], y=at[:, 1], z=at[:, 2]
            )
        )
    for i, shape in enumerate(shapes() @ TURN if 55 in kinds else ()):
        moved = np.sqrt(MODAL_MASS) * shape
        sets.append(
            pyuff.prepare_55(
                model_type=1,
                analysis_type=2,
                data_ch=2,
                spec_data_type=8,
                data_type=2,
                n_data_per_node=3,
                r1=moved[:, 0],
                r2=moved[:, 1],
                r3=moved[:, 2],
                node_nums=number,
                load_case=1,
                mode_n=i + 1,
                freq=HERTZ[i],
                modal_m=MODAL_MASS,
                modal_damp_vis=0.013 if i == 2 else 0.0,
                modal_damp_his=0.0,
            )
        )
    pyuff.UFF(str(path)).write_sets(sets, "overwrite")


def box(path: Path, **changes: object) -> ModeFile:
    given: dict[str, object] = {
        "name": "tested",
        "bearing": "HS130x230",
        "modes": path,
        "mass": 70.0,
        "inertia": (1.0, 2.0, 3.0),
        "products": (0.0, 0.0, 0.0),
        "sensors": (TOP,),
        "length_unit": "mm",
        "forward": "z",
        "left": "x",
        "up": "y",
        "origin": tuple(ORIGIN),
    }
    return ModeFile(**{**given, **changes})  # type: ignore[arg-type]


def test_modes_come_back_in_the_axlebox_frame(tmp_path: Path) -> None:
    write(tmp_path / "modes.unv")
    modes = modes_of_file(box(tmp_path / "modes.unv"), BEARING)
    assert modes.frequency == pytest.approx([1500.0, 2600.0])  # rigid motion is left out
    assert modes.damping_ratio == pytest.approx([0.013, 0.02])
    expected = np.zeros((2, 2, 3, 17))
    expected[0, :, 0, 2] = 1.0  # cos 2
    expected[0, :, 1, 10] = -0.5  # sin 2
    expected[1, 1, 0, 11] = 1.0  # sin 3
    expected[1, 1, 2, 0] = 0.25
    assert modes.raceway == pytest.approx(expected, abs=1e-4)
    assert modes.seats["top"] == pytest.approx(np.array([[0.0, 0.0, 1.5], [0.0, 0.0, 0.0]]), abs=1e-4)


def test_a_mode_without_damping_has_that_of_the_box_at_its_frequency(tmp_path: Path) -> None:
    write(tmp_path / "modes.unv")
    table = DampingTable((1000.0, 2000.0), (0.03, 0.01))
    modes = modes_of_file(box(tmp_path / "modes.unv", damping_ratio=table), BEARING)
    assert modes.damping_ratio == pytest.approx([0.013, 0.01])


def test_the_command_writes_the_table(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(tmp_path / "modes.unv", unit=1.0)
    (tmp_path / "mine.yaml").write_text(
        "name: mine\nbearing: HS130x230\nmodes: modes.unv\n"
        "mass_kg: 70\ninertia_kg_m2: [2, 2, 3]\nproducts_kg_m2: [0.1, 0, -0.2]\n"
        "forward: z\nleft: x\nup: y\norigin_mm: [500, -200, 100]\n"
        "sensors: [{name: top, position_mm: [0, 0, 170], radius_mm: 5}]\n"
    )
    words = ["structure", str(tmp_path / "mine.yaml"), "-o", str(tmp_path / "table.csv")]
    assert command.main(words) == command.DONE
    assert "2 free modes: 1500, 2600 Hz" in capsys.readouterr().out
    modes = read_table(tmp_path / "table.csv")
    assert (modes.name, modes.cup.bearing, modes.products) == ("mine", "HS130x230", (0.1, 0.0, -0.2))


def test_products_of_inertia_are_asked_for_and_must_be_of_a_body(tmp_path: Path) -> None:
    (tmp_path / "mine.yaml").write_text(
        "name: mine\nbearing: HS130x230\nmodes: modes.unv\nmass_kg: 70\ninertia_kg_m2: [1, 2, 3]\n"
        "sensors: [{name: top, position_mm: [0, 0, 170]}]\n"
    )
    with pytest.raises(InputError, match="products_kg_m2 is missing"):
        load_box(tmp_path / "mine.yaml")
    with pytest.raises(InputError, match="are of no body"):
        box(tmp_path / "modes.unv", products=(2.0, 0.0, 0.0))
    with pytest.raises(InputError, match="are of no body"):  # the centre of mass takes more than there is
        box(tmp_path / "modes.unv", centre=(0.0, 0.0, 0.2))


def test_what_a_file_lacks_is_told(tmp_path: Path) -> None:
    path = tmp_path / "modes.unv"
    for kinds, words in (((15,), "there are no normal modes"), ((55,), "there are no nodes")):
        write(path, kinds=kinds)
        with pytest.raises(InputError, match=words):
            modes_of_file(box(path), BEARING)
    path.write_text("    -1\n    55\nbroken\n    -1\n")
    with pytest.raises(InputError, match=r"modes\.unv: "):
        modes_of_file(box(path), BEARING)
    with pytest.raises(InputError, match="no such file"):
        modes_of_file(box(tmp_path / "none.unv"), BEARING)


def test_axes_and_places_that_cannot_be_are_told(tmp_path: Path) -> None:
    path = tmp_path / "modes.unv"
    write(path)
    with pytest.raises(InputError, match="forward, left and up are x, y, -z"):
        box(path, forward="x", left="y", up="-z")
    with pytest.raises(InputError) as found:
        modes_of_file(box(path, length_unit="m"), BEARING)
    told = "\n".join(found.value.problems)
    assert "nodes lie at 0 azimuths" in told
    assert "no node within radius_mm 5 of the seat 'top'" in told


def test_nodes_on_a_saddle_do_not_tell_the_waves_apart(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """150 degrees of the circle: a fit would make coefficients of hundreds of the noise."""
    angle = np.radians(np.arange(-75, 76, 10))
    rings = [
        np.stack([RADIUS * np.sin(angle), np.full(len(angle), place), RADIUS * np.cos(angle)], axis=1)
        for place in row_places(BEARING)
    ]
    monkeypatch.setattr(f"{__name__}.nodes", lambda: np.concatenate([*rings, [TOP.position]]))
    write(tmp_path / "modes.unv")
    with pytest.raises(InputError, match="leave 210 degrees of the circle empty"):
        modes_of_file(box(tmp_path / "modes.unv"), BEARING)
