"""Published standard deviations of track irregularity spectra."""

import numpy as np
import pytest

from beardyn_core.rail.irregularity import rail_profile
from beardyn_core.scene.operation import Irregularity


@pytest.mark.parametrize(
    ("kind", "deviation_mm"),
    # ERRI B176 low and high disturbance, FRA class 6: one-sided density integrated over 3 to 150 m
    [("german_low", 2.86), ("german_high", 4.69), ("fra_6", 4.32)],
)
def test_standard_deviation_over_3_to_150_m(kind, deviation_mm):
    profile = rail_profile(Irregularity(kind, 3.0, 150.0), 1.0e5, seed=11)
    assert 1e3 * np.std(profile.height) == pytest.approx(deviation_mm, rel=0.03)
