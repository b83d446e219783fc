"""Bad configuration: every mistake at once, each a sentence with file, key, value and what is allowed."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.choice import load_scene, scene_from_text
from beardyn_core.config import load_bearing, load_effects, scene_text
from beardyn_core.config.folders import find
from beardyn_core.config.yaml_text import read_file, read_mapping, write_mapping
from beardyn_core.effects import Cage, KinematicCage, LandGuidance, PocketFilm, RotatingCage
from beardyn_core.rail.build import load_history
from beardyn_core.rail.measured import read_measurement
from beardyn_core.scene.load_check import problem_with
from beardyn_core.scene.operation import SteppedOperation
from beardyn_core.scene.patch import Patch

GOOD = """\
scene: mine
bearing: HS130x230
lubricant: L055
operation: {kind: constant, force_kN: [0, 0, 80], speed_rpm: 1000}
defects:
  - {on: cup, row: 0, width_mm: 6, depth_um: 100, length_mm: 20}
"""

Write = Callable[[str], Path]


@pytest.fixture
def write(tmp_path: Path) -> Write:
    def write(text: str, name: str = "mine.yaml") -> Path:
        path = tmp_path / name
        path.write_text(text)
        return path

    return write


def problems_of(path: Path | str, **overrides: object) -> list[str]:
    with pytest.raises(InputError) as caught:
        load_scene(path, **overrides)  # type: ignore[arg-type]
    return caught.value.problems


def test_the_unspoilt_scene_loads(write: Write) -> None:
    (defect,) = load_scene(write(GOOD)).defects
    assert isinstance(defect, Patch)
    assert defect.width == 6e-3


@pytest.mark.parametrize(
    ("good", "bad", "words"),
    [
        ("width_mm: 6", "width_cm: 0.6", ["defects[0].width_cm", "`width_mm`", "millimetres"]),
        ("width_mm: 6", "width_mm: 3 mm", ["defects[0].width_mm is '3 mm'", "number", "millimetres"]),
        ("width_mm: 6", "width_mm: -6", ["defects[0].width_mm is -6", "greater than 0"]),
        ("width_mm: 6", "width_mm: .nan", ["defects[0].width_mm is nan", "finite"]),
        ("width_mm: 6", "width_mm: true", ["defects[0].width_mm is True", "number"]),
        ("speed_rpm: 1000", "speed_rpm: .inf", ["operation.speed_rpm is inf", "finite"]),
        (
            "speed_rpm: 1000",
            "speed_rad_s: 100",
            ["operation.speed_rad_s", "`speed_rpm`", "revolutions per minute"],
        ),
        (
            "force_kN: [0, 0, 80]",
            "force_N: [0, 0, 80000]",
            ["operation.force_N", "`force_kN`", "kilonewtons"],
        ),
        ("force_kN: [0, 0, 80]", "force_kN: [0, 80]", ["operation.force_kN is [0, 80]", "3 entries"]),
        ("force_kN: [0, 0, 80]", "force_kN: 80", ["operation.force_kN is 80", "list"]),
        ("kind: constant", "kind: constnat", ["operation.kind is 'constnat'", "did you mean 'constant'"]),
        ("kind: constant, ", "", ["operation.kind is missing", "'quarter_vehicle'"]),
        ("on: cup", "on: cone_ring", ["defects[0].on is 'cone_ring'", "'cup', 'cone', 'roller'"]),
        ("row: 0", "row: 2", ["defects[0].row is 2", "at most 1"]),
        ("row: 0", "row: 0.5", ["defects[0].row is 0.5", "whole number"]),
        ("length_mm: 20", "length_mm: 60", ["defects[0].length_mm is 60", "50"]),
        ("length_mm: 20", "length_mm: 20, offset_mm: 20", ["defects[0].offset_mm is 20", "beyond"]),
        ("on: cup", "on: roller, roller: 17", ["defects[0].roller is 17", "0 to 16"]),
        ("bearing: HS130x230", "bearing: HS130x231", ["bearing", "'HS130x231'", "did you mean HS130x230?"]),
        ("bearing: HS130x230", "bearing: ./mine_own.yaml", ["bearing", "mine_own.yaml", "searched"]),
        ("bearing: HS130x230", "bearing: 7", ["bearing is 7", "a name or a mapping"]),
        ("lubricant: L055", "lubricants: L055", ["lubricants", "did you mean `lubricant`?"]),
        ("scene: mine\n", "", ["scene is missing"]),
        ("scene: mine", "scene: mine\nscene: yours", ["line 2", "'scene' is given twice", "line 1"]),
        ("scene: mine", "scene: [mine", ["line 2"]),
        ("scene: mine", "scene: mine\neffects: standart", ["effects", "did you mean standard?"]),
        ("scene: mine", "scene: mine\neffects: {preset: dry, flim: true}", ["effects.flim", "`film`"]),
        ("scene: mine", "scene: mine\neffects: {preset: dry, film: 3}", ["effects.film is 3"]),
        ("scene: mine", "scene: mine\ntier: lumpd", ["tier is 'lumpd'", "'full'"]),
        (
            "scene: mine",
            "scene: mine\ntier: lumped\neffects: {preset: standard, rib: false}",
            ["tier: 'lumped'", "effects.rib", "absent"],
        ),
        (
            "scene: mine",
            "scene: mine\ntier: quasistatic\nnumerics: {laminae: 1}",
            ["tier: 'quasistatic'", "numerics.laminae", "at least 2"],
        ),
        ("scene: mine", "scene: mine\ntemperature_K: 340", ["temperature_K", "`temperature_C`", "Celsius"]),
        ("scene: mine", "scene: mine\nduration_s: 0", ["duration_s is 0", "greater than 0"]),
        ("scene: mine", "scene: mine\nsensors: []", ["sensors is []", "at least 1"]),
        ("scene: mine", "scene: mine\nsensors: [{}, {}]", ["sensors[1].name", "twice"]),
        (
            "scene: mine",
            "scene: mine\nsensors: [{rate_kHz: 48}]",
            ["sensors[0]", "rate_kHz is 48", "25.6 or 51.2"],
        ),
        (
            "scene: mine",
            "scene: mine\nsensors: [{mounting_damping_ratio: 0.1}]",
            ["sensors[0]", "without mounting_resonance_Hz"],
        ),
        (
            "scene: mine",
            "scene: mine\nsensors: [{mounting_resonance_Hz: 9}]",
            ["sensors[0].mounting_resonance_Hz is 9", "500"],
        ),
        (
            "scene: mine",
            "scene: mine\nsensors: [{rate_kHz: 51.2}]\nnumerics: {steps_per_sample: 4}",
            ["'axlebox_top' at 51.2 kHz", "steps_per_sample of at least 8 and even, not 4"],
        ),
        ("scene: mine", "scene: mine\n3: 4", ["line 2", "the key 3 is not a word"]),
    ],
)
def test_a_mistake_is_one_sentence_with_file_key_value_and_what_is_allowed(
    write: Write, good: str, bad: str, words: list[str]
) -> None:
    assert good in GOOD
    path = write(GOOD.replace(good, bad, 1))
    (problem,) = problems_of(path)
    assert problem.startswith(str(path))
    for word in words:
        assert word in problem


def test_all_mistakes_of_the_scene_and_its_files_are_reported_together(write: Write, tmp_path: Path) -> None:
    bearing = read_file(find("bearings", "HS130x230"))
    bearing["roller_count"] = "seventeen"
    del bearing["bore_mm"]
    own = tmp_path / "own.yaml"
    own.write_text(write_mapping(bearing))
    text = GOOD.replace("HS130x230", "own.yaml").replace("width_mm: 6", "width_mm: 0").replace("L055", "L55")
    found = problems_of(write(text + "colour: red\n"))
    assert len(found) == 5
    assert sum(problem.startswith(f"{own}: ") for problem in found) == 2
    assert any(problem.startswith(f"{own}: roller_count is 'seventeen'") for problem in found)
    assert any(problem.startswith(f"{own}: bore_mm is missing") for problem in found)
    assert any("'L55'" in problem for problem in found)
    assert any("colour" in problem for problem in found)
    assert any("width_mm is 0" in problem for problem in found)


def test_contradictory_geometry_is_refused_with_the_numbers(tmp_path: Path) -> None:
    bearing = read_file(find("bearings", "HS130x230"))
    bearing["effective_length_mm"] = 54.0
    bearing["outer_diameter_mm"] = 200.0
    path = tmp_path / "own.yaml"
    path.write_text(write_mapping(bearing))
    with pytest.raises(InputError) as caught:
        load_bearing(path)
    first, second = caught.value.problems
    assert "54 mm" in first
    assert "52 mm" in first
    assert "outer_diameter" in second
    assert "100 mm" in second


def test_missing_scene_names_the_places_searched(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (problem,) = problems_of("none/there.yaml")
    assert str(tmp_path / "none" / "there.yaml") in problem


def test_missing_configuration_folder_names_the_place(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("BEARDYN_CONFIG", str(tmp_path / "nowhere"))
    (problem,) = problems_of("cup_spall")
    assert str(tmp_path / "nowhere") in problem


@pytest.mark.parametrize(
    "content", [b"", b"- 1\n- 2\n", b"just words", b"\xff\xfe\x00", b"a: {b: [", b"\ta: 1"]
)
def test_a_file_that_is_no_mapping_is_refused(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "odd.yaml"
    path.write_bytes(content)
    (problem,) = problems_of(path)
    assert problem.startswith(str(path))


def test_overrides_are_checked_like_the_file(write: Write) -> None:
    found = problems_of(write(GOOD), duration=-1.0, laminae=0, effects="standart", seed=-1)
    assert len(found) == 4
    for words in (
        "--duration -1.0; it must",
        "--laminae 0; it must",
        "--effects: there is no",
        "--seed -1; it",
    ):
        assert any(problem.startswith(words) for problem in found)
    (problem,) = problems_of(write(GOOD), duration=float("nan"))
    assert problem.startswith("--duration nan; it must be a finite number")


def test_a_refused_entry_does_not_make_its_list_too_short(write: Write) -> None:
    profile = "kind: quarter_vehicle, vehicle: emu_300, speed_profile: [{time_s: 0, speed_kmh: %s}]"
    good = GOOD[: GOOD.index("operation:")] + "operation: {" + profile + "}\n"
    found = problems_of(write(good % "-500"))
    assert any("speed_kmh is -500" in problem for problem in found)
    assert not [problem for problem in found if "entries" in problem]


def test_a_folder_is_not_a_scene(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "mine").mkdir()
    monkeypatch.chdir(tmp_path)
    for name in (str(tmp_path), "mine", "mine/"):
        (problem,) = problems_of(name)
        assert "is a folder; give the path of a scene file" in problem


def test_a_measured_load_that_is_not_utf_8_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "load.csv"
    path.write_bytes("time_s,fz_N\n0,1 # München\n".encode("latin-1"))
    with pytest.raises(InputError, match="is not UTF-8 text"):
        read_measurement(path)


def test_overrides_replace_what_the_file_says(write: Write) -> None:
    scene = load_scene(write(GOOD), duration=0.5, laminae=8, seed=3, effects="dry", tier="full")
    assert (scene.duration, scene.numerics.laminae, scene.seed) == (0.5, 8, 3)
    assert scene.effects == load_effects("dry")


def test_effects_of_a_preset_can_be_changed_one_by_one(write: Write) -> None:
    text = GOOD + "effects: {preset: standard, film: null, cage: {initial_speed_ratio: 0.9}, rib: true}\n"
    standard, changed = load_effects("standard"), load_scene(write(text)).effects
    assert changed.film is None
    assert isinstance(changed.cage, Cage)
    assert isinstance(standard.cage, Cage)
    assert changed.cage.initial_speed_ratio == 0.9
    assert changed.cage.friction == standard.cage.friction
    assert changed.rib == standard.rib


def test_a_cage_is_the_free_one_unless_it_says_otherwise(write: Write) -> None:
    def cage(text: str) -> object:
        return load_scene(write(GOOD + f"effects: {{cage: {text}}}\n")).effects.cage

    assert cage("true") == cage("{}") == cage("{kind: six_dof}") == Cage()
    assert cage("false") is None
    assert cage("{kind: rotating, pocket_wear_mm: 0.5}") == RotatingCage(pocket_wear=5e-4)
    assert cage("{kind: kinematic}") == KinematicCage()
    assert cage("{lubrication: true, guidance: {on: cone}}") == Cage(
        lubrication=PocketFilm(), guidance=LandGuidance(on="cone")
    )
    preset = load_scene(write(GOOD + "effects: {preset: dry, cage: {lubrication: true}}\n")).effects.cage
    assert preset == Cage(friction=0.15, lubrication=PocketFilm())
    said = GOOD + "effects: {preset: dry, cage: {kind: six_dof, lubrication: true}}\n"
    assert load_scene(write(said)).effects.cage == preset


@pytest.mark.parametrize(
    ("cage", "words"),
    [
        ("{kind: loose}", ["effects.cage.kind is 'loose'", "allowed are 'six_dof', 'rotating', 'kinematic'"]),
        ("{kind: rotating, lubrication: true}", ["effects.cage.lubrication", "unknown key"]),
        ("{pocket_wear_mm: -1}", ["effects.cage.pocket_wear_mm is -1", "at least 0"]),
        ("{guidance: {on: rib}}", ["effects.cage.guidance.on is 'rib'", "allowed are 'cup', 'cone'"]),
        ("{guidance: {clearance_um: 3}}", ["effects.cage.guidance.clearance_um", "`clearance_mm`"]),
        ("{lubrication: {layer_um: 0}}", ["effects.cage.lubrication.layer_um is 0", "greater than 0"]),
        ("7", ["effects.cage is 7"]),
    ],
)
def test_a_mistake_in_a_cage_is_one_sentence(write: Write, cage: str, words: list[str]) -> None:
    (sentence,) = problems_of(write(GOOD + f"effects: {{cage: {cage}}}\n"))
    for word in words:
        assert word in sentence


def test_effects_without_a_preset_are_those_named(write: Write) -> None:
    effects = load_scene(
        write(GOOD + "effects: {traction: {kind: coulomb, friction: 0.05}, gravity: true}\n")
    ).effects
    assert effects.names() == ("traction", "gravity")


def test_yaml_words_and_numbers_are_those_of_yaml_1_2(write: Write) -> None:
    text = GOOD.replace("width_mm: 6", "width_mm: 6e0").replace("scene: mine", "scene: off")
    scene = load_scene(write(text))
    assert scene.name == "off"
    defect = scene.defects[0]
    assert isinstance(defect, Patch)
    assert (defect.on, defect.width) == ("cup", 6e-3)
    assert write_mapping({"a": "1e3", "b": "on", "c": 1e-7}) == "{a: '1e3', b: 'on', c: 1.0e-07}\n"


def test_measured_load_is_checked_with_the_scene(write: Write, tmp_path: Path) -> None:
    (tmp_path / "load.csv").write_text("time_s,speed_rpm,fx_N,fy_N,fz_N\n0,1000,0,0,5e4\n0.1,1000,0,0,nan\n")
    text = GOOD.replace(
        "{kind: constant, force_kN: [0, 0, 80], speed_rpm: 1000}", "{kind: csv, path: load.csv}"
    )
    found = problems_of(write(text.replace("width_mm: 6", "width_mm: 0")))
    assert any("load.csv" in problem and "nan" in problem for problem in found)
    assert any("width_mm" in problem for problem in found)


@pytest.mark.parametrize(
    ("effects", "words"),
    [
        ("film: {formula: reynolds}", ["effects.film", "formula is 'reynolds'", "'pan_hamrock'"]),
        ("film: {thermal: hot}", ["thermal is 'hot'", "'murch_wilson'"]),
        ("film: {isoviscous: 1}", ["isoviscous"]),
        ("film: {thickening: eyring}", ["thickening is 'eyring'", "'roelands'"]),
        ("traction: {kind: coulomb, regularisation: tanh}", ["regularisation is 'tanh'", "'threlfall'"]),
        (
            "traction: {kind: coulomb, regularisation: ambrosio, regularisation_start_m_per_s: 0.02}",
            ["regularisation_start_m_per_s is 0.02", "less than", "0.01"],
        ),
        (
            "traction: {kind: mixed, regularisation_start_m_per_s: 0.001}",
            ["regularisation_start_m_per_s is 0.001", "only the regularisation ambrosio"],
        ),
        ("traction: {kind: load_sharing, film_traction: newton}", ["film_traction is 'newton'", "'aihara'"]),
        (
            "traction: {kind: load_sharing, eyring_stress_MPa: -5}",
            ["eyring_stress_MPa is -5", "greater than 0"],
        ),
        (
            "traction: {kind: load_sharing, friction: 0.1}",
            ["effects.traction.friction: unknown key", "boundary_friction"],
        ),
    ],
)
def test_wrong_film_and_traction_options_are_explained(write: Write, effects: str, words: list[str]) -> None:
    found = problems_of(write(f"{GOOD}effects: {{{effects}}}\n"))
    assert len(found) == 1
    assert all(word in found[0] for word in words), found


def test_lubricant_without_pressure_viscosity_has_that_of_its_base_oil(write: Write) -> None:
    oil = read_file(find("lubricants", "SHC100"))
    del oil["pressure_viscosity_per_GPa"]
    loaded = load_scene(write(write_mapping({**read_file(find("scenes", "static_80kN")), "lubricant": oil})))
    assert loaded.lubricant.pressure_viscosity == pytest.approx(13.65e-9, rel=1e-3)
    again = scene_from_text(scene_text(loaded))
    assert again.lubricant == loaded.lubricant


@pytest.mark.parametrize(
    ("effects", "end"),
    [
        ("film: {isoviscous: 1}", "effects.film.isoviscous is 1; it must be true or false"),
        ("rib: {window: 3}", "effects.rib.window is 3; it must be true or false"),
        ("film: 3", "effects.film is 3; it must be true, false or a mapping of keys to values"),
    ],
)
def test_a_mistake_in_a_switch_says_what_it_takes(write: Write, effects: str, end: str) -> None:
    (sentence,) = problems_of(write(GOOD + f"effects: {{{effects}}}\n"))
    assert sentence.endswith(end)


def test_an_unknown_key_is_the_only_complaint_about_its_mapping(write: Write) -> None:
    (sentence,) = problems_of(write(GOOD + "effects: {thermal: true, audits: true}\n"))
    assert "effects.audits: unknown key; did you mean `audit`?" in sentence


def test_what_is_changed_in_a_mapping_is_not_in_the_next_one_of_the_same_text() -> None:
    first = read_mapping("deep: {list: [1, 2]}", "a.yaml")
    first["deep"]["list"].append(3)
    assert read_mapping("deep: {list: [1, 2]}", "b.yaml") == {"deep": {"list": [1, 2]}}


def test_a_speed_that_jumps_as_no_wheelset_does_is_refused_with_its_key(write: Write) -> None:
    def problems(ramp: float, rpm: float) -> list[str]:
        levels = [{"time_s": time, "force_kN": [0, 0, 8], "speed_rpm": time * rpm} for time in (0, 1)]
        operation = {"kind": "stepped", "ramp_s": ramp, "steps": levels}
        try:
            scene = load_scene(write(write_mapping({**read_mapping(GOOD, "mine"), "operation": operation})))
        except InputError as error:
            return error.problems
        assert isinstance(scene.operation, SteppedOperation)
        load = load_history(scene.operation, scene.mounting, 1.2, 1)
        assert problem_with(load, None) is None  # what the scene may say, the run takes
        return []

    assert problems(0.0, 470.0) == []
    assert problems(0.011, 5900.0) == []
    (problem,) = problems(0.0, 480.0)
    assert "operation: steps[1].speed_rpm changes by 480 within ramp_s 0" in problem
    assert "make ramp_s at least" in problem
    (problem,) = problems(0.009, 5900.0)
    needed = float(problem.rsplit(" ", 1)[1])
    assert problems(needed, 5900.0) == []
