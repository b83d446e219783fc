"""A recorded scene holds its table of modes and its measured paths: it is read where their files are not."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

from beardyn_core.base.errors import InputError
from beardyn_core.base.packed import pack_file, unpack_file
from beardyn_core.config.content import self_contained
from beardyn_core.config.load import read_scene, read_scene_text
from beardyn_core.config.nouns import load_effects
from beardyn_core.config.yaml_text import scene_text
from beardyn_core.effects import EffectSet, ModalStructure
from beardyn_core.rail.transfer_path import path_read, read_transfer_path
from beardyn_core.scene.scene import Scene
from beardyn_core.structure.mounted_box import modes_of_effects, table_path

OPERATION = {"kind": "constant", "force_kN": [0, 0, 80], "speed_rpm": 1165}
MODES = {"kind": "modes", "table": "mine.CSV"}


def written(folder: Path, **parts: Any) -> Path:
    """A scene of one's own in a folder."""
    folder.mkdir(exist_ok=True)
    scene = {"scene": "mine", "bearing": "HS130x230", "lubricant": "L055", "operation": OPERATION, **parts}
    (folder / "scene.yaml").write_text(yaml.safe_dump(scene))
    return folder / "scene.yaml"


def with_table(folder: Path) -> Path:
    """A folder with a table of one's own, whose ending is in capitals."""
    folder.mkdir(exist_ok=True)
    (folder / "mine.CSV").write_text(table_path("high_speed").read_text())
    return folder


def frequencies(scene: Scene) -> list[float]:
    modes = modes_of_effects(scene.effects)
    assert modes is not None
    return list(modes.frequency)


def test_a_recorded_scene_needs_no_table(tmp_path: Path) -> None:
    folder = with_table(tmp_path / "here")
    scene = read_scene(written(folder, effects={"structure": MODES})).scene
    expected, text = frequencies(scene), scene_text(scene)
    folder.rename(tmp_path / "there")
    again = read_scene_text(text).scene
    assert again == scene
    assert frequencies(again) == expected


def test_a_recorded_scene_needs_no_measured_path(tmp_path: Path) -> None:
    folder = tmp_path / "here"
    folder.mkdir()
    rows = [f"{hertz},{20.0 / 3.0 / hertz},{1.0 / 7.0}" for hertz in range(5, 2000, 5)]
    (folder / "path.csv").write_text("\n".join(["frequency_Hz,magnitude_dB,phase_deg", *rows]))
    sensor = {"name": "top", "measured_paths": [{"path": "path.csv", "axes": ["z"]}]}
    scene = read_scene(written(folder, sensors=[sensor])).scene
    expected, text = read_transfer_path(folder / "path.csv"), scene_text(scene)
    folder.rename(tmp_path / "there")
    again = read_scene_text(text).scene
    assert again == scene
    measured = again.sensors[0].measured_paths[0]
    found = path_read(measured.content, measured.path)
    np.testing.assert_array_equal(found.frequency, expected.frequency)
    np.testing.assert_array_equal(found.ratio, expected.ratio)


def test_a_scene_made_in_python_takes_its_table_along(tmp_path: Path) -> None:
    table = with_table(tmp_path) / "mine.CSV"
    made = EffectSet(structure=ModalStructure(str(table)))
    scene = read_scene(
        written(tmp_path, effects={"structure": {"kind": "modes", "table": "high_speed"}})
    ).scene
    assert self_contained(scene) is scene  # a shipped table stays a name
    text = scene_text(replace(scene, effects=made))
    table.unlink()
    assert frequencies(read_scene_text(text).scene) == frequencies(scene)


def test_the_table_of_a_file_of_effects_lies_beside_that_file(tmp_path: Path) -> None:
    library = with_table(tmp_path / "library")
    (library / "effects.yaml").write_text(yaml.safe_dump({"name": "mine", "purpose": "", "structure": MODES}))
    for effects in ("../library/effects.yaml", {"preset": "../library/effects.yaml", "gravity": True}):
        scene = read_scene(written(tmp_path / "scenes", effects=effects)).scene
        assert len(frequencies(scene)) > 90
    modes = modes_of_effects(load_effects(library / "effects.yaml"))
    assert modes is not None
    # content of the table before goes with it
    recorded = {**MODES, "content": pack_file(table_path("metro").read_text(), library / "mine.CSV")}
    (library / "effects.yaml").write_text(yaml.safe_dump({"name": "mine", "structure": recorded}))
    changed = {"preset": "../library/effects.yaml", "structure": {"table": "high_speed"}}
    assert len(frequencies(read_scene(written(tmp_path / "scenes", effects=changed)).scene)) == len(
        modes.frequency
    )
    # a table that the scene names lies beside the scene
    beside = {"preset": "../library/effects.yaml", "structure": {"table": "none.csv"}}
    with pytest.raises(InputError, match=r"scenes/none\.csv: cannot be read"):
        read_scene(written(tmp_path / "scenes", effects=beside))


def test_the_content_of_another_file_is_refused(tmp_path: Path) -> None:
    """A recording that is read on another machine names the same file, perhaps with other slashes."""
    folder = with_table(tmp_path / "here")
    rows = [f"{hertz},1,0" for hertz in range(5, 2000, 5)]
    (folder / "path.csv").write_text("\n".join(["frequency_Hz,real,imaginary", *rows]))
    (folder / "other.csv").write_text(table_path("metro").read_text())
    sensor = {"name": "top", "position_mm": [0, 0, 170], "measured_paths": [{"path": "path.csv"}]}
    parts: dict[str, dict[str, Any]] = {
        "mine.CSV": {"effects": {"structure": MODES}},
        "path.csv": {"sensors": [sensor]},
    }
    for name, part in parts.items():
        text = scene_text(read_scene(written(folder, **part)).scene)
        here = str(folder.resolve() / name)
        assert text.count(here) == 1
        for other in (str(folder / "other.csv"), str(tmp_path / "there" / name), "other.csv"):
            with pytest.raises(InputError) as found:
                read_scene_text(text.replace(here, other))
            told = "\n".join(found.value.problems)
            assert f"{other}: content next to it is that of {here}; leave content out" in told
    assert unpack_file(pack_file("1", "/a/b.csv"), "C:\\a\\b.csv") == "1"


@pytest.mark.parametrize("word", ["AAAA", "no base64", "eJw="])
def test_a_damaged_content_is_told(word: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"mine\.CSV: content cannot be unpacked"):
        read_scene(written(tmp_path, effects={"structure": {**MODES, "content": word}}))
    sensor = {"name": "top", "measured_paths": [{"path": "p.csv", "content": word}]}
    with pytest.raises(InputError, match=r"p\.csv: content cannot be unpacked"):
        read_scene(written(tmp_path, sensors=[sensor]))
