"""The golden numbers: statistics of the first 0.1 s of the standard scene.

Regenerate, after a change of the model that is meant, from the root of the checkout::

    python -m test.golden.golden

and say in the changelog why they moved.
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from beardyn_core.choice import load_scene
from test.runs import Record, record

FILE = Path(__file__).with_name("static_80kN.json")
DURATION_S = 0.1


def statistics(run: Record) -> dict[str, float]:
    """A few dozen numbers: means of the channels, and loads by azimuth sector of 45 degrees.

    The scatter of forces and moments that vanish by symmetry is chaos alone and no reference.
    """
    numbers: dict[str, float] = {}
    waveform = run.force_waveform
    for i, name in enumerate(("fx", "fy", "fz", "mx", "my", "mz")):
        numbers[f"force.{name}.mean"] = float(waveform[:, i].mean())
    numbers["force.fx.rms"] = float(waveform[:, 0].std())
    torque = run.trend("shaft_torque")
    numbers["shaft_torque.mean"], numbers["shaft_torque.rms"] = float(torque.mean()), float(torque.std())
    for row in (0, 1):
        numbers[f"cage_speed.{row}.mean"] = float(run.trend("cage_speed")[:, row].mean())
        numbers[f"roller_speed.{row}.mean"] = float(run.trend("roller_speed")[:, row].mean())
    contacts = np.concatenate([block.contacts for block in run.blocks])
    load = np.linalg.norm(contacts[..., 3:6], axis=-1)
    azimuth = np.arctan2(contacts[..., 0, 0], contacts[..., 0, 2])
    for kind, name in enumerate(("cup", "cone", "rib")):
        numbers[f"load.{name}.largest"] = float(load[..., kind].max())
        for sector in (-2, -1, 0, 1, 2):
            here = np.abs(azimuth - sector * np.pi / 4) < np.pi / 8
            numbers[f"load.{name}.at {45 * sector} deg"] = float(load[..., kind][here].mean())
    numbers["film.cup.mean"] = float(contacts[..., 0, 7][load[..., 0] > 100.0].mean())
    audit = run.blocks[-1].audit
    assert audit is not None
    numbers["energy.external"] = audit.external
    numbers["energy.dissipated"] = audit.dissipated
    return numbers


def standard_statistics() -> dict[str, float]:
    return statistics(record(load_scene("static_80kN"), DURATION_S))


if __name__ == "__main__":
    FILE.write_text(
        json.dumps({k: float(f"{v:.9g}") for k, v in standard_statistics().items()}, indent=1) + "\n"
    )
    print(f"wrote {FILE}")
