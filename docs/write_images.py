"""Make the picture of the images of the load in rail.md: ``python docs/write_images.py``, two minutes."""

from __future__ import annotations

import io
import sys
from dataclasses import replace
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from PIL import Image
from scipy.signal import welch

from beardyn_core.choice import load_scene
from beardyn_core.run import blocks
from beardyn_core.scene import band_limited
from beardyn_core.scene.operation import Irregularity, QuarterVehicleOperation

sys.path.insert(0, str(Path(__file__).parents[1]))
from evidence.stamps import stamp

PICTURE = Path(__file__).with_name("pictures") / "load_images.png"
COLOURS = 32
SCENE, TIER = "healthy_80", "quasistatic"


def spectrum() -> tuple[np.ndarray, np.ndarray]:
    """Simulate the scene without sensor noise: frequency [kHz] and density of the box's acceleration [dB]."""
    scene = load_scene(SCENE, tier=TIER, duration=3.0)
    assert isinstance(scene.operation, QuarterVehicleOperation)
    rail = Irregularity("fra_4", shortest_wavelength=0.1, short_waves="none")  # a load at 2 kHz
    scene = replace(scene, operation=replace(scene.operation, irregularity=rail))
    silent = tuple(replace(sensor, noise_density=0.0) for sensor in scene.sensors)
    readings = [block.vibration[0] for block in blocks(replace(scene, sensors=silent))]
    vertical = np.concatenate([reading.acceleration[:, 2] for reading in readings])
    frequency, density = welch(vertical[round(0.3 * readings[0].rate) :], readings[0].rate, nperseg=4096)
    return frequency * 1e-3, 10.0 * np.log10(density)


def main() -> None:
    """Draw both ways to go from sample to sample, the straight one by taking the bows away."""
    frequency, smooth = spectrum()
    band_limited.POLYNOMIALS[:] = 0.0
    _, straight = spectrum()
    figure, panel = plt.subplots(figsize=(7.2, 3.0), dpi=100, layout="constrained")
    panel.plot(
        frequency, straight, color="tab:red", linewidth=0.8, label="straight lines between the samples"
    )
    panel.plot(frequency, smooth, color="tab:blue", linewidth=0.8, label="band-limited, as it is")
    panel.set(xlim=(0.0, 11.0), ylim=(-110.0, 0.0), xlabel="frequency [kHz]")
    panel.set_ylabel("dB re 1 (m/s²)²/Hz")
    panel.set_xticks(range(0, 12, 2))
    panel.grid(alpha=0.3)
    panel.legend(frameon=False, fontsize=8)
    drawn = io.BytesIO()
    figure.savefig(drawn, format="png")
    Image.open(drawn).convert("RGB").quantize(COLOURS).save(PICTURE, optimize=True)
    stamp(PICTURE)


if __name__ == "__main__":
    main()
