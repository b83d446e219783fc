"""What a spall does to a roller that is held between the rings: its edges rigid, as in the twin, and elastic.

A law is the sink of a roller over a slot, at the same load, by arc and load. The held roller shows what it
does to the force without the bearing's dynamics: both rings stand still, the roller is pressed by a cone as
firm as the sound cup, and carries on the sound half of its length what the other gives up.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache

import numpy as np
from scipy.optimize import brentq
from scipy.signal import butter, sosfiltfilt

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.contact_law import line_contact_factor
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.kinematics import cage_speed
from beardyn_core.config import load_bearing
from beardyn_core.physics.defect import surface_radius
from beardyn_core.physics.patch_path import edge_softness, reach_of, roller_path
from beardyn_core.scene.patch import Patch
from evidence.impact.cases import BEARING, DEPTH, WHEEL_RADIUS
from evidence.impact.elastic import cup_radius, sink

LAWS = ("rigid", "ours", "elastic")
LOADS = (300.0, 1e3, 2e3, 5e3, 1e4, 2e4)  # at which the elastic roller is worked out [N]
BEYOND = 0.3e-3  # of the edge: no roller of these loads feels it from there [m]
STEP = 5e-6  # of the way of a held roller [m]
BAND = (2e3, 10e3)  # in which its force is judged, [Hz]


def sound_depth(bearing: Bearing, load: Float | float) -> Float:
    """Work out the penetration of a sound contact under a load of the roller [N], [m]."""
    factor = line_contact_factor(bearing.material, bearing.effective_length)
    return np.asarray((np.asarray(load) / factor) ** 0.9)


def own_path(bearing: Bearing, width: float) -> tuple[Float, Float, Float]:
    """Take arcs from the middle of a spall, path and extra depth over the sound one, [m], [m], [-]."""
    patch = Patch("cup", 0, 0.0, width, DEPTH, bearing.effective_length)
    size, radius = patch.size_at(0.0), cup_radius(bearing)
    reach = reach_of(patch, size, radius, bearing)
    path = roller_path(patch, size, radius, reach)
    softness = edge_softness(patch, size, radius, reach, path, bearing)
    return np.linspace(0.0, reach, len(path)), path, (1.0 + softness) ** 0.9 - 1.0


def sinks(bearing: Bearing, law: str, width: float, arc: float, loads: Float) -> Float:
    """Work out the sink by a law at an arc from the middle of a slot under loads [N], shape [load], [m]."""
    if law == "elastic":
        return np.array([min(sink(bearing, width, arc, load), DEPTH) for load in loads])
    arcs, path, more = own_path(bearing, width)
    rigid = np.full(len(loads), np.interp(arc, arcs, path))
    return rigid if law == "rigid" else rigid + np.interp(arc, arcs, more) * sound_depth(bearing, loads)


def load_of(bearing: Bearing, law: str, width: float, arc: float) -> Callable[[float], float]:
    """Make the function from the penetration below the sound surface [m] to the load of a roller [N].

    Between `LOADS` the depth of the sound contact under the same load is linear in the penetration.
    """
    loads = np.array(LOADS)
    deeper = sinks(bearing, law, width, arc, loads)
    depths = np.concatenate([[0.0], sound_depth(bearing, loads)])
    places = depths + np.concatenate([deeper[:1], deeper])
    factor = line_contact_factor(bearing.material, bearing.effective_length)

    def load(penetration: float) -> float:
        return float(factor * np.interp(penetration, places, depths) ** (10.0 / 9.0))

    return load


@cache
def held_force(law: str, width: float, load: float) -> tuple[Float, Float]:
    """Compute the force on a held roller of HS130x230 over half of which a spall lies, [m], [N].

    ``load``: of the roller far from the spall [N]. Returns ways from one side of the spall to the other, and
    the force at each.
    """
    bearing = load_bearing(BEARING)
    factor = line_contact_factor(bearing.material, bearing.effective_length)
    closed = 2.0 * float(sound_depth(bearing, load))
    # inside of the edges by more than this the deepest roller is free
    way = np.arange(max(0.5 * width - 0.9e-3, 0.0), 0.5 * width + BEYOND, 2e-5)
    force = []
    for arc in way:
        over = load_of(bearing, law, width, float(arc))

        def excess(depth: float, over: Callable[[float], float] = over) -> float:
            sound = factor * depth ** (10.0 / 9.0)
            return 0.5 * (sound + over(depth)) - factor * (closed - depth) ** (10.0 / 9.0)

        depth = brentq(excess, 1e-9, closed - 1e-12)
        force.append(factor * (closed - depth) ** (10.0 / 9.0))
    whole = np.arange(-0.5 * width - BEYOND, 0.5 * width + BEYOND, STEP)
    return whole, np.interp(np.abs(whole), way, force)


def strike(law: str, width: float, load: float, speed: float) -> float:
    """Find the largest force in `BAND` on a held roller that passes a spall at a speed [km/h], [N]."""
    bearing = load_bearing(BEARING)
    rolling = cage_speed(bearing, speed / 3.6 / WHEEL_RADIUS) * surface_radius(bearing, "cup")
    force = held_force(law, width, load)[1]
    silent = np.full(math.ceil(2e-3 * rolling / STEP), force[-1])
    band = butter(2, BAND, "bandpass", fs=rolling / STEP, output="sos")
    received = sosfiltfilt(band, np.concatenate([silent, force, silent]))
    return float(np.abs(received).max())
