"""Effects that are off by default leave no code: the step is no larger than one that never had them.

For the comparison all kernels are built anew with the hooks of those effects cut out: functions that hand
back what they were given. Two kernels, half a minute of compiling each, hence slow.
"""

from __future__ import annotations

import importlib
import pkgutil
from dataclasses import replace
from typing import Any

import numba
import numpy as np
import pytest

from beardyn_core import physics
from beardyn_core.base.jit import OPTIONS, inline
from beardyn_core.physics.tiers import imex
from test.effects.fresh_kernels import instruction_count
from test.kernels.rig import Rig
from test.scenes import scene_with

pytestmark = pytest.mark.slow

# What each hook of an effect that is off by default comes to without it: arguments, and what it hands back.
CUT = {
    # rolling resistance
    "prepare_rolling": ("contact, ring, view, body, rolling", "0.0"),
    "push_rolling": ("moment, contact, rolling", "moment"),
    "settle_rolling": ("ring, contact, change, total, here, rolling, p", "total"),
    # drag
    "prepare_drag": ("body, view, drag", "0.0"),
    "stiffen_drag": ("matrix, contact, step, drag", "matrix"),
    "push_drag": ("total, contact, drag", "total"),
    "settle_drag": ("contact, change, total, here, drag, p", "total"),
    # small rib
    "prepare_small_rib": ("body, view, zero, rib", "0.0"),
    "stiffen_small_rib": ("matrix, contact, rib, p", "matrix"),
    "push_small_rib": ("total, contact, rib", "total"),
    "settle_small_rib": ("contact, change, total, here, rib, p", "total"),
    # options of the rib
    "with_spin": ("sliding, reach, spin, drilling", "sliding"),
    "_resist_spin": ("matrix, contact, step, drilling", "matrix"),
    "_add_drilling_moment": ("moment, contact, spin, drilling", "moment"),
    "_drilling_loss": ("contact, d_spin, drilling", "(0.0, 0.0)"),
    "rib_log2_film": ("load, speed, film", "0.0"),
    # structure
    "bent_cup": ("lanes, bends, view, radius, cosine, sine, structure", "(view, 0.0)"),
    "about_rigid_cup": ("contact, shift, structure", "contact"),
    "bend_cup": ("force, here, structure", "None"),
    "show_structure": ("lanes, flex, box, step, bend, structure", "None"),
    "kick_structure": ("flex, sums, box, signal, energy, step, bend, structure", "0.0"),
    "structure_energy": ("flex, structure", "0.0"),
    # axle that bends
    "add_bending": ("bodies, axle, share, journal", "None"),
    "axle_energy": ("axle, journal", "0.0"),
    # seals, lands, cages that follow the rings
    "add_seals": ("bodies, wrenches, energy, step, seal", "None"),
    "brake_cages": ("bodies, wrenches, energy, step, drags", "None"),
    "push_lands": ("bodies, wrenches, cage, land", "0.0"),
    "settle_lands": ("bodies, pushed, energy, step, cage, land", "0.0"),
    "place_cages": ("bodies, cage", "None"),
    "pass_on": ("bodies, wrenches, energy, step, cage, gravity", "None"),
    # coupled laminae, faults and waviness
    "prepare_coupling": ("lanes, approach, laminae, damage, coupling", "None"),
    "find_damage": ("lanes, block, azimuths, count, surfaces, damage", "False"),
    "springs_of": ("laminae, damage, coupling", "(laminae, laminae.shape[1])"),
    "spring_damage": ("lanes, spring, damage", "(1.0, 0.0)"),
    "soften_by_edges": ("lanes, tangent, spring, damage", "tangent"),
    "_slopes_of": ("lanes, k, depth, count, damage, coupling", "(0.0, 0.0)"),
    "_add_lean": ("lean, load, slopes, damage", "lean"),
    "_gap_rate": ("slopes, turning, damage", "0.0"),
    "_less_gap_rate": ("rate, gap_rate, damage", "rate"),
    "_add_gap": ("gap, tangent, x, slopes, gap_rate, damage", "gap"),
    "_release_gap": ("released, power, damage", "released"),
    "contact_turning": ("body, view, damage", "(0.0, 0.0)"),
    "_less_gap": ("damped, gap, damage", "damped"),
    "_gap_power": ("weighted_squares, rate, gap, damage", "weighted_squares"),
    "add_leaning_change": ("wrench, gap, d_rate, time, body, damage", "wrench"),
    "_deepest_so_far": ("deepest, share, depth, damage", "deepest"),
    "lean_wrench": ("lanes, body, sums, climbs, damage, waves, roller_waves", "0.0"),
    "add_leaning": ("wrench, lean", "wrench"),
    "wave_gap": ("lanes, block, azimuth, waves", "(0.0, 0.0)"),
    "shift_line": ("line, gap", "line"),
    "pocket_wear": ("lanes, block, pockets", "0.0"),
    # scatter
    "pocket_length": ("lanes, block, pockets", "0.0"),
    "crown_bend": ("lanes, block, crowns", "0.0"),
    "bend_line": ("line, bend, crowns", "line"),
    # timers
    "time_step": ("timers, step", "None"),
    "mark": ("timers, stage", "None"),
    "mark_result": ("timers, stage, result", "None"),
    # options of film and traction
    "log2_thermal_factor": ("log2_rolling, thermal", "0.0"),
    "thicker_film": ("elastic, load, log2_rolling, lamina, ring, rigid", "elastic"),
}


def cut_out(name: str) -> Any:
    """The hook of an absent effect as if it had never been written."""
    arguments, result = CUT[name]
    space: dict[str, Any] = {}
    exec(f"def {name}({arguments}):\n    return {result}\n", space)  # the compiler reads the signature
    return inline(space[name])


def step_without_hooks(monkeypatch: pytest.MonkeyPatch) -> Any:
    """`advance` of kernels that are all built anew, the hooks cut out."""
    modules = [
        importlib.import_module(found.name)
        for found in pkgutil.walk_packages(physics.__path__, f"{physics.__name__}.")
    ]
    built: dict[int, Any] = {}
    cut = set()
    for module in (*modules, imex):
        for name, value in list(vars(module).items()):
            if not isinstance(value, numba.core.registry.CPUDispatcher) or value is imex.advance:
                continue
            if id(value) not in built:
                cut |= {name} & set(CUT)
                built[id(value)] = cut_out(name) if name in CUT else inline(value.py_func)
            monkeypatch.setattr(module, name, built[id(value)])
    assert cut == set(CUT)  # no hook was renamed
    return numba.njit(**OPTIONS)(imex.advance.py_func)


def without_timers() -> Rig:
    """The 80 kN rig; timers are on in every run, and absent here like the effects."""
    rig = Rig.at_equilibrium(scene_with())
    effects = rig.parameters.effects._replace(timers=None)
    return replace(rig, parameters=rig.parameters._replace(effects=effects))


def test_standard_step_is_no_larger_than_one_without_the_hooks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Not one arithmetic instruction more, the same bits; moves depend on where registers spill."""
    whole = numba.njit(**OPTIONS)(imex.advance.py_func)
    signals = without_timers().run(64, kernel=whole)[0]
    bare = step_without_hooks(monkeypatch)
    np.testing.assert_array_equal(without_timers().run(64, kernel=bare)[0], signals)
    assert instruction_count(bare) > 3000
    assert instruction_count(whole) <= instruction_count(bare)
