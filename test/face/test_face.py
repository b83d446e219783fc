"""`import beardyn_core as bd`: what is there, how light it is, and that it does what it says."""

from __future__ import annotations

import inspect
import pickle
import time
from pathlib import Path

import numpy as np
import pytest

import beardyn_core as bd
from beardyn_core import run as run_module
from beardyn_core.base.edge import write_noun
from beardyn_core.base.errors import in_python
from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.cli.main import main
from beardyn_core.config import shipped_names
from beardyn_core.config.folders import find
from beardyn_core.config.nouns import bearing_from_mapping
from beardyn_core.effects import EffectSet
from beardyn_core.record.sinks import MemorySink
from beardyn_core.scene.field_spall import FieldSpall
from beardyn_core.scene.operation import QuarterVehicleOperation
from beardyn_core.structure.mounted_box import modes_of_effects
from beardyn_core.study import desk_run
from test.commands import run_python
from test.face.test_one_run import spalled
from test.study.test_desk_run import SENTENCE, PureRolling

HEAVY = ("numba", "rerun", "matplotlib", "rclpy", "pydantic", "scipy", "numpy", "yaml", "xarray", "pandas")


def fresh(code: str) -> str:
    """Output of a new interpreter."""
    return run_python(code).strip()


def test_importing_is_light_and_quick() -> None:
    code = "import sys, time; t = time.perf_counter(); import beardyn_core; t = time.perf_counter() - t; "
    loaded = fresh(code + f"print(sorted(set({HEAVY}) & set(sys.modules)))")
    assert loaded == "[]"
    assert min(float(fresh(code + "print(t)")) for _ in range(3)) < 0.2


def test_every_name_is_there_documented_and_offered_for_completion() -> None:
    assert sorted(bd.__all__) == list(bd.__all__)
    for name in bd.__all__:
        assert name in dir(bd)
        found = getattr(bd, name)
        assert inspect.getdoc(found), name
        assert callable(found) or inspect.ismodule(found)
    with pytest.raises(AttributeError, match="no attribute 'simulat'"):
        _ = bd.simulat  # type: ignore[attr-defined]


def test_errors_come_without_the_rest() -> None:
    code = "import sys, beardyn_core as bd; bd.InputError, bd.ValidityError; "
    assert fresh(code + f"print(sorted(set({HEAVY}) & set(sys.modules)))") == "[]"


@pytest.mark.parametrize(
    "call", ["bd.read('none.mcap')", "bd.monitor('none.mcap')", "bd.bearing('HS130x230')"]
)
def test_what_needs_no_kernel_brings_no_compiler_along(call: str) -> None:
    code = f"import contextlib, sys, beardyn_core as bd\nwith contextlib.suppress(bd.InputError): {call}\n"
    assert fresh(code + "print('numba' in sys.modules)") == "False"


def test_the_rooms_of_the_same_name_still_are_rooms() -> None:
    code = "import beardyn_core.scene.scene as room, beardyn_core as bd; "
    assert fresh(code + "print(room.Scene is bd.Scene, bd.scene.scene is room)") == "True True"
    assert "faults" in inspect.signature(bd.scene).parameters
    assert "rollers" in inspect.signature(bd.bearing).parameters
    assert (inspect.getdoc(bd.bearing) or "").startswith("Give a shipped bearing")


def test_simulate_gives_the_run_of_a_desk_run(tmp_path: Path) -> None:
    path = tmp_path / "run.mcap"
    run = bd.simulate("cup_spall", tier="quasistatic", duration=0.5, record=path)
    memory = MemorySink()
    summary = desk_run.run(spalled(), [memory])
    np.testing.assert_array_equal(run.vibration.values, memory.to_run().vibration.values)
    assert run.status == "complete"
    for name in ("mean_force", "shaft_torque", "cage_speed_ratio", "life", "faults"):
        assert getattr(run.summary, name) == getattr(summary, name), name
    back = bd.read(path)
    np.testing.assert_array_equal(back.force.values, run.force.values)
    assert back.truth == run.truth
    with pytest.raises(bd.InputError, match="exists"):
        bd.simulate("cup_spall", tier="quasistatic", duration=0.5, record=path)
    again = bd.simulate("cup_spall", tier="quasistatic", duration=0.1, record=path, force=True)
    assert bd.read(path).duration == again.duration < run.duration
    assert bd.monitor(path).analyses == bd.monitor(again).analyses
    sent = pickle.loads(pickle.dumps(run))  # from a worker process
    np.testing.assert_array_equal(sent.vibration.values, run.vibration.values)
    assert sent.summary == run.summary


def test_what_is_unusual_is_warned_of_in_python_too() -> None:
    change = {"tier": "quasistatic", "duration": 0.1, "load_kN": 0.5}
    with pytest.warns(UserWarning, match="operation|defects") as caught:
        bd.simulate("static_80kN", faults=[{"on": "cup", "width_mm": 60}], **change)  # type: ignore[arg-type]
    told = [str(each.message) for each in caught]
    assert any("operation.force_kN: the force is 500 N, less than a thousandth" in each for each in told)
    assert any("defects[0]" in each and "between two rollers" in each for each in told)


def test_no_file_that_a_scene_is_made_of_is_written_over(tmp_path: Path) -> None:
    mine = tmp_path / "mine.yaml"
    mine.write_bytes((shipped_folder() / "HS130x230.yaml").read_bytes())
    with pytest.raises(bd.InputError, match="the command reads this file"):
        bd.simulate("static_80kN", tier="lumped", duration=0.1, bearing=str(mine), record=mine, force=True)
    assert bd.bearing(mine) == bd.bearing("HS130x230")


def shipped_folder() -> Path:
    return find("bearings", "HS130x230").parent


def test_faults_that_are_no_list_of_mappings_are_a_sentence() -> None:
    fault = {"on": "cup", "width_mm": 6}
    for wrong in (fault, "cup", ["cup"], 5):
        with pytest.raises(bd.InputError, match="it must be a list of mappings"):
            bd.scene("static_80kN", faults=wrong)  # type: ignore[arg-type]
    made = bd.scene("static_80kN", faults=(each for each in [fault]))  # type: ignore[arg-type]
    assert made == bd.scene("static_80kN", faults=[fault])


def test_scenes_and_bearings_take_numbers_of_numpy_and_nouns() -> None:
    fault = {"on": "cup", "width_mm": np.float64(6), "row": np.int64(1)}
    made = bd.scene("static_80kN", load_kN=np.int64(8), seed=np.int64(5), faults=[fault])  # type: ignore[arg-type]
    plain = bd.scene("static_80kN", load_kN=8, seed=5, faults=[{"on": "cup", "width_mm": 6, "row": 1}])
    assert made == plain
    assert bd.scene(load_kN=np.array([0, 0, 8])) == bd.scene(load_kN=8)  # type: ignore[arg-type]
    shipped = bd.bearing("HS130x230")
    assert bd.bearing(shipped) == shipped
    assert bd.bearing(shipped, end_play_mm=0.1) == bd.bearing("HS130x230", end_play_mm=0.1)
    assert bd.scene(lubricant=bd.lubricant("L055")) == bd.scene(lubricant="L055")
    with pytest.raises(bd.InputError, match=r"force_kN is '80'; it must be a list"):
        bd.scene(load_kN="80")  # type: ignore[arg-type]


def test_a_run_that_leaves_its_validity_warns_and_keeps_its_arrays(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(run_module, "Twin", type("Twin", (PureRolling,), {"invalid_at": 3}))
    with pytest.warns(RuntimeWarning, match=SENTENCE):
        run = bd.simulate("static_80kN", duration=0.5)
    assert run.status == SENTENCE
    assert not run.summary.complete
    assert run.duration == pytest.approx(0.08)
    assert len(run.vibration) == 4 * 512


def test_a_mapping_a_name_and_a_scene_are_the_same_to_simulate() -> None:
    mapping = {
        "scene": "mine",
        "bearing": "HS130x230",
        "lubricant": "L055",
        "operation": {"kind": "constant", "force_kN": [0, 0, 80], "speed_rpm": 1000},
        "tier": "lumped",
        "duration_s": 0.1,
    }
    one = bd.simulate(mapping)
    two = bd.simulate(bd.scene(tier="lumped", duration=0.1))
    np.testing.assert_array_equal(one.force.values, two.force.values)
    assert one.truth["condition"] == "healthy"
    shorter = bd.simulate(bd.scene(mapping), duration=0.06)
    assert shorter.duration == pytest.approx(0.06)


def test_a_scene_is_made_of_a_handful_of_arguments() -> None:
    bearing = bd.bearing(
        rollers=20, pitch_diameter_mm=180, roller_diameter_mm=24, roller_length_mm=45, contact_angle_deg=10
    )
    scene = bd.scene(
        bearing=bearing, load_kN=60, speed_rpm=800, faults=[{"on": "cone", "width_mm": 5}], tier="lumped",
        end_play_mm=0.05, temperature_C=40.0, duration=0.1, seed=7,
    )  # fmt: skip
    assert scene.bearing == bearing
    assert scene.end_play == pytest.approx(5e-5)
    assert (scene.seed, scene.tier, scene.temperature) == (7, "lumped", 313.15)
    assert scene.faults[0].on == "cone"
    truth = bd.simulate(scene).truth
    assert truth["load"]["fz_N"]["mean"] == pytest.approx(60e3)
    assert truth["speed"]["rpm"]["mean"] == pytest.approx(800.0)
    assert truth["geometry"]["roller_count"] == 20
    faster = bd.scene("cup_spall", speed_kmh=80, faults=[], duration=0.1)
    assert not faster.faults
    assert bd.scene(scene, tier="quasistatic").tier == "quasistatic"
    assert bd.scene(effects=EffectSet(gravity=None)).effects.gravity is None


def test_a_field_spall_in_code_has_its_own_depth() -> None:
    (spall,) = bd.scene("static_80kN", faults=[{"kind": "field_spall", "on": "cup", "width_mm": 6}]).defects
    assert isinstance(spall, FieldSpall)
    assert (spall.on, spall.row, spall.width) == ("cup", 0, 6e-3)


def test_what_a_bearing_in_code_assumes_stands_beside_it() -> None:
    made = bd.bearing(
        rollers=17, pitch_diameter_mm=185, roller_diameter_mm=26.7, roller_length_mm=52,
        contact_angle_deg=10.5, end_play_mm=0.1,
    )  # fmt: skip
    known = bd.bearing("HS130x230")
    for name in ("roller_count", "pitch_diameter", "roller_diameter", "contact_angle", "effective_length"):
        assert getattr(made, name) == getattr(known, name), name
    for name in ("bore", "outer_diameter", "width", "row_spacing", "cup_mass", "roller_mass"):
        assert getattr(made, name) == pytest.approx(getattr(known, name), rel=0.06), name
    assert made.cone_mass == pytest.approx(known.cone_mass, rel=0.2)
    assert fault_frequencies(made) == fault_frequencies(known)
    assert made.end_play == 1e-4
    sources = dict(made.sources)
    assert sources["bore"].startswith("derived")
    assert sources["rib_contact_height"].startswith("assumed")
    with pytest.raises(bd.InputError, match="contact_angle_deg is missing"):
        bd.bearing(rollers=17, pitch_diameter_mm=185, roller_diameter_mm=26.7, roller_length_mm=52)
    with pytest.raises(bd.InputError, match="roller_diameter_mm is -1"):
        bd.bearing(
            rollers=17, pitch_diameter_mm=185, roller_diameter_mm=-1, roller_length_mm=52, contact_angle_deg=9
        )


def test_a_bearing_with_changes_has_a_name_of_its_own() -> None:
    shipped = bd.bearing("HS130x230")
    assert bd.bearing("HS130x230", name="mine").name == "mine"
    assert bd.bearing(shipped, name="mine").pitch_diameter == shipped.pitch_diameter
    assert bd.name_plate("6205", name="mine").name == "mine"
    with pytest.raises(bd.InputError, match=r"the bearing of this name is bearing\('HS130x230'\)"):
        bd.bearing(name="HS130x230")


def test_messages_name_options_of_the_command_there_and_arguments_in_python(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "box.csv"
    file.write_text("acc_z\n" + "\n".join(f"{number % 7 - 3}" for number in range(5000)), encoding="utf-8")
    with pytest.raises(bd.InputError) as refused:
        bd.read_measured(file)
    assert "give unit, one of" in str(refused.value)
    assert "give rate_Hz or time_channel" in str(refused.value)
    assert "--" not in str(refused.value)
    assert main(["monitor", str(file), "--bearing", "6205", "--speed-rpm", "1800"]) == 2
    printed = capsys.readouterr().err
    assert "give --unit, one of" in printed
    assert "give --rate-hz or --time-channel" in printed
    kept = in_python("--force replaces it, `beardyn train --bearing FILE` makes one, 3--4, a --b-hz")
    assert kept == "force=True replaces it, `beardyn train --bearing FILE` makes one, 3--4, a b_Hz"


@pytest.mark.parametrize("name", shipped_names("bearings"))
def test_a_bearing_goes_to_its_keys_and_back(name: str) -> None:
    bearing = bd.bearing(name)
    assert bearing_from_mapping(write_noun(bearing), "keys") == bearing


def test_contradictions_of_a_scene_in_code_are_sentences() -> None:
    for wrong, said in (
        ({"speed_kmh": 100}, "does not run on a track"),
        ({"load_kN": 50, "speed_kmh": 100}, "speed_rpm"),
        ({"tier": "medium"}, "lumped"),
        ({"faults": [{"on": "cup", "widht_mm": 3}]}, "width_mm"),
    ):
        with pytest.raises(bd.InputError, match=said):
            bd.scene(**wrong)


def test_representations_are_short() -> None:
    scene = bd.scene("cup_spall")
    block = next(bd.blocks(bd.scene("static_80kN", tier="lumped"), duration=0.02))
    static = bd.equilibrium("HS130x230", 80.0)
    summary = bd.simulate(bd.scene("static_80kN", tier="lumped"), duration=0.02).summary
    for line in map(repr, (scene.lubricant, static, summary)):
        assert len(line) < 200, line
        assert len(line.splitlines()) == 1
    for thing in (scene, scene.bearing, scene.effects, bd.EffectSet(), block):
        assert len(repr(thing)) < 400
        assert len(repr(thing).splitlines()) <= 2
    assert "HS130x230" in repr(scene)
    assert "spall on the cup" in repr(scene)
    service = bd.scene("service_metro")
    modes = modes_of_effects(service.effects)
    assert isinstance(service.operation, QuarterVehicleOperation)
    for noun in (service.background, service.sensors[0].type, service.operation.vehicle, modes):
        assert len(repr(noun)) < 120
        assert len(repr(noun).splitlines()) == 1
    assert (
        repr(service.background) == "Background driven_metro: roughness, drive, other_bearing, knocks, pickup"
    )


def test_simulating_again_does_not_load_again() -> None:
    """A second run of a process costs the simulation and its load, not imports and kernels."""
    scene = bd.scene("static_80kN", tier="lumped", duration=0.1)
    bd.simulate(scene)
    began = time.perf_counter()
    for _ in range(3):
        bd.simulate(scene)
    assert (time.perf_counter() - began) / 3 < 2.0
