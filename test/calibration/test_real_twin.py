"""A calibration with a real twin: what was hidden in a recording is found."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml

import beardyn_core as bd
from beardyn_core.base.edge import write_noun

SCENE = "service_high_speed"
FREQUENCY, NOISE = 1.07, 0.04


@pytest.mark.slow
@pytest.mark.usefixtures("shipped_configuration")
def test_a_box_that_rings_higher_and_a_louder_accelerometer_are_found(tmp_path: Path) -> None:
    """The recording is of another track and another bearing of the lot, in the tier of the twin."""
    base = write_noun(bd.scene(SCENE))
    structure = {"kind": "modes", "table": "high_speed", "stiffness_factor": FREQUENCY**2}
    recording = tmp_path / "hidden.mcap"
    bd.simulate(
        SCENE,
        tier="quasistatic",
        effects={"preset": "auto", "structure": structure},
        sensors=[{**base["sensors"][0], "noise_density_m_per_s2_per_sqrt_Hz": NOISE}],
        seed=77,
        scatter={**base["scatter"], "seed": 78},
        duration=3.5,
        record=recording,
    )
    found = bd.calibrate(recording, SCENE, tmp_path / "mine.yaml", fit=["frequency", "noise"], budget=42)
    for name, truth, near in (("frequency", FREQUENCY, 0.02), ("noise", NOISE, 0.15)):
        fit = found[name]
        assert not fit.reason, fit
        assert fit.interval[0] <= truth <= fit.interval[1], fit
        assert fit.value == pytest.approx(truth, rel=near)
    assert found.residuals[1] < 0.7 * found.residuals[0]
    mine = yaml.safe_load((tmp_path / "mine.yaml").read_text(encoding="utf-8"))
    assert mine["effects"]["structure"]["stiffness_factor"] == pytest.approx(
        found["frequency"].value ** 2, rel=1e-3
    )  # four digits in the file
