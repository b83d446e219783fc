"""The double-row bearing HH926700 of Zhang, Lv, Han, Li 2023, Sensors 23:4967: their model and ours."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
from scipy.optimize import brentq

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.kinematics import cage_speed_ratio
from beardyn_core.config import load_bearing
from beardyn_core.physics.statics.static import StaticSolution, solve


def solved_model(radial: float, axial: float) -> StaticSolution:
    """Solve their case: 100 N preload a row, 20 N m, cage at 1200 rpm."""
    bearing = hh926700()
    speed = 1200.0 * math.pi / 30.0 / cage_speed_ratio(bearing)

    def preload_missing(end_play: float) -> float:
        solution = solve(bearing, (0, 0, 0), end_play=end_play)
        return float(solution.cup_load[0].sum()) * math.sin(bearing.cup_angle) - 100.0

    end_play = brentq(preload_missing, -2.0e-5, 0.0, xtol=1e-12)
    return solve(bearing, (0, axial, radial), (-20.0, 0, 0), end_play=end_play, tilt="free", speed=speed)


def hh926700() -> Bearing:
    """Build the bearing HH926700 from what its paper gives."""
    model = load_bearing("HS130x230")
    bearing = dataclasses.replace(
        model,
        name="HH926700",
        roller_count=14,
        pitch_diameter=198.93e-3,
        roller_diameter=0.5 * (30.27e-3 + 36.74e-3),
        effective_length=57.02e-3,
        roller_length=58.8e-3,
        contact_angle=math.radians(0.5 * (22.54 + 16.24)),
        row_spacing=75.96e-3,
        bore=110e-3,
        outer_diameter=280e-3,
        width=190e-3,
        nominal_cup_angle=math.radians(22.54),
        nominal_cone_angle=math.radians(16.24),
        angle_tolerance=math.radians(0.06),
        material=dataclasses.replace(model.material, youngs_modulus=2.1e11),
    )
    density = bearing.material.density * 0.126 / bearing.roller_mass
    return dataclasses.replace(bearing, material=dataclasses.replace(bearing.material, density=density))


def published_model(radial: float, axial: float) -> float:
    """Return the largest cup load of the published model; x along the radial load, z along the axle."""
    count, pitch_radius, offset, factor = 14, 0.19893 / 2, 0.07596 / 2, 6.0e9
    cup, rib = math.radians(22.54), math.radians(70.20)
    centrifugal = 0.126 * (1200.0 * math.pi / 30.0) ** 2 * pitch_radius
    least = centrifugal * math.sin(rib) / math.sin(cup + rib)
    preload = (100.0 / (count * factor * math.sin(cup))) ** 0.9
    angle = 2.0 * math.pi * np.arange(count) / count
    rows = []
    for position, sign in ((-offset, 1.0), (offset, -1.0)):
        ones = np.ones(count)
        normal = np.stack(
            [math.cos(cup) * np.cos(angle), math.cos(cup) * np.sin(angle), sign * math.sin(cup) * ones],
            axis=1,
        )
        point = np.stack(
            [pitch_radius * np.cos(angle), pitch_radius * np.sin(angle), position * ones], axis=1
        )
        rows.append(np.hstack([normal, np.cross(point, normal)[:, :2] / pitch_radius]))
    direction = np.vstack(rows)
    load = np.array([radial, 0.0, axial, 0.0, -20.0 / pitch_radius])
    floor = (least / factor) ** 0.9

    def at(unknowns):
        approach = direction @ unknowns + preload
        force = factor * np.maximum(approach, floor) ** (10.0 / 9.0)
        energy = 9.0 / 19.0 * force * np.maximum(approach, floor) + least * np.minimum(approach - floor, 0.0)
        stiffness = np.where(approach > floor, 10.0 / 9.0 * force / np.maximum(approach, floor), 0.0)
        hessian = (direction.T * stiffness) @ direction
        return energy.sum() - load @ unknowns, direction.T @ force - load, hessian, force

    unknowns, damping = np.zeros(5), 1.0e9
    energy, gradient, hessian, force = at(unknowns)
    for _ in range(200):
        if np.abs(gradient).max() < 1.0e-7:
            return float(force.max())
        moved = unknowns - np.linalg.solve(hessian + damping * np.eye(5), gradient)
        trial = at(moved)
        if trial[0] < energy or np.abs(trial[1]).max() < np.abs(gradient).max():
            unknowns, (energy, gradient, hessian, force) = moved, trial
            damping = max(0.2 * damping, 1.0)
        else:
            damping *= 5.0
    raise AssertionError("the published model did not converge")
