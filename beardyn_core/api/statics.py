"""Answers that need no run: stiffness, torque, life, film, load distribution, fault frequencies.

Every function takes a bearing of any kind or its name, a load in kN upwards on the journal or along x, y,
z, and a scalar or a sequence of what it is asked over. Rings bend unless ``rings="rigid"``: the cup in a
housing with a wall of 25 mm, as the effect ``structure`` of kind ``rings`` has it in runs. Torque and film
are those of tapered and cylindrical bearings.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from numbers import Real
from typing import TYPE_CHECKING, Any, Literal

from beardyn_core.api.static_inputs import (
    answer_each,
    find_bearing,
    find_lubricant,
    find_with_lines,
    find_with_play,
    limit_problem,
    read_film,
    read_force,
    read_shaft_speed,
    read_temperature,
)
from beardyn_core.base.errors import InputError

if TYPE_CHECKING:
    from beardyn_core.base.arrays import Float
    from beardyn_core.bearing.lubricant import Lubricant
    from beardyn_core.bearing.roller_bearing import RollerBearing
    from beardyn_core.physics.statics.rating_life import RatingLife
    from beardyn_core.physics.statics.static import StaticSolution

Load = float | Sequence[float]

_KN, _MM, _RPM = 1e3, 1e3, math.pi / 30.0
_SLOWEST = 1e-6  # [m/s]


def equilibrium(
    bearing: RollerBearing | str,
    load_kN: Load = 80.0,
    *,
    end_play_mm: float | None = None,
    radial_clearance_mm: float | None = None,
    speed_rpm: float = 0.0,
    tilt: Literal["locked", "free"] = "locked",
    laminae: int | None = None,
    rings: Literal["elastic", "rigid"] = "elastic",
) -> StaticSolution:
    """Solve the static equilibrium of a bearing: displacement, roller loads, stiffness.

    Parameters
    ----------
    bearing : Bearing or str
        Name of a shipped bearing of any kind or path of a YAML file; in Python also a bearing.
    load_kN : float or 3 floats
        Force on the cone, axlebox frame (x forward, y left along the axle, z up), kN; default 0 0 80. A
        number alone is upwards.
    end_play_mm : float, optional
        Total axial travel, mm, negative: preload; default that of the bearing file. Spherical roller bearings
        have none.
    radial_clearance_mm : float, optional
        Total radial travel of cylindrical and spherical roller bearings, mm; default that of the bearing
        file.
    speed_rpm : float
        Shaft speed, rpm. It gives the inertia forces of the rollers.
    tilt : str
        Tilt of the cone against the cup. ``locked`` or ``free``.
    laminae : int
        Slices (laminae) of each raceway contact; default 1 of tapered bearings, 30 of others. With 1 the
        rollers do not tilt.
    rings : str
        ``elastic``: the cup bends in a housing with a wall of 25 mm, as in runs with the effect structure;
        ``rigid``: only the contacts yield, as in catalogues. Elastic rings spread the load over more rollers;
        ISO 16281 has rigid ones. The housing is assumed: name the box of yours in a scene.

    Returns
    -------
    StaticSolution
        SI units; ``cup_load`` is the load distribution, shape [row, roller].

    Raises
    ------
    InputError, ValidityError
        An argument makes no sense; there is no equilibrium.
    """
    from beardyn_core.physics.modal_body import bending_rings
    from beardyn_core.physics.statics.static import solve

    chosen, end_play = find_with_play(bearing, end_play_mm, radial_clearance_mm)
    return solve(
        chosen,
        read_force(chosen, load_kN),
        end_play=end_play,
        tilt=tilt,
        laminae=chosen.usual_laminae if laminae is None else laminae,
        speed=read_shaft_speed(speed_rpm),
        body=bending_rings(chosen, rings),
    )


def load_distribution(bearing: RollerBearing | str, load_kN: Load = 80.0, **options: Any) -> Float:
    """Give the load of every roller on the cup, shape [row, roller], [N]; options as of `equilibrium`."""
    return equilibrium(bearing, load_kN, **options).cup_load


def stiffness(
    bearing: RollerBearing | str,
    load_kN: Load = 80.0,
    *,
    end_play_mm: float | Sequence[float] | None = None,
    radial_clearance_mm: float | Sequence[float] | None = None,
    tilt: Literal["locked", "free"] = "locked",
    laminae: int | None = None,
    rings: Literal["elastic", "rigid"] = "elastic",
) -> Float:
    """Give the stiffness of a bearing against its end play, preload or radial clearance.

    Parameters
    ----------
    bearing, load_kN, tilt, laminae, rings
        See `equilibrium`; with ``tilt="free"`` the tilt follows the displacement.
    end_play_mm : float or sequence, optional
        Negative for preload; by default the bearing's own.
    radial_clearance_mm : float or sequence, optional
        Of cylindrical and spherical roller bearings; by default the bearing's own.

    Returns
    -------
    float64 array, shape [3, 3] or [case, 3, 3]
        Change of the load along x, y, z with the displacement along x, y, z, [N/m].
    """

    def one(**play: Any) -> Float:
        found = equilibrium(bearing, load_kN, **play, tilt=tilt, laminae=laminae, rings=rings)
        return found.stiffness_tilt_free if tilt == "free" else found.stiffness_tilt_held

    if end_play_mm is None and radial_clearance_mm is None:
        return one()
    if radial_clearance_mm is None:
        return answer_each("end_play_mm", end_play_mm, lambda play: one(end_play_mm=play))
    if end_play_mm is not None and not isinstance(end_play_mm, Real):
        raise InputError("end_play_mm is a sequence; with radial_clearance_mm it must be a number")
    return answer_each(
        "radial_clearance_mm",
        radial_clearance_mm,
        lambda play: one(radial_clearance_mm=play, end_play_mm=end_play_mm),
    )


def torque(
    bearing: RollerBearing | str,
    speed_rpm: float | Sequence[float],
    load_kN: Load = 80.0,
    *,
    lubricant: Lubricant | str = "L055",
    temperature_C: float = 70.0,
    rib_friction: float | None = None,
    supply: str = "settled",
    end_play_mm: float | None = None,
    rings: Literal["elastic", "rigid"] = "elastic",
) -> Any:
    """Give the running torque of raceways and ribs against speed, in pure rolling.

    Parameters
    ----------
    bearing, load_kN, end_play_mm, rings
        See `equilibrium`.
    speed_rpm : float or sequence
        Of the shaft.
    lubricant : Lubricant or str
    temperature_C : float
        At the inlets of the contacts.
    rib_friction : float, optional
        Coefficient of friction on the ribs; by default film and asperities share the load, as in runs.
    supply : str
        Oil on the raceways, as in a scene: ``flooded``, or grease ``fresh``, ``settled``, ``channelled``.

    Returns
    -------
    float or float64 array, shape [speed]
        [N m]. Seals, churning and cages are not in it: simulate a scene with ``effects="all"`` for those.

    References
    ----------
    See `beardyn_core.physics.statics.torque.running_torque`.
    """
    from beardyn_core.effects import Rib, RibMixedFilm, RollingResistance
    from beardyn_core.physics.rolling_resistance import oil_supply
    from beardyn_core.physics.statics.torque import running_torque

    chosen = find_with_lines(bearing, "torques")
    oil, kelvin = find_lubricant(lubricant), read_temperature(temperature_C)
    found = oil_supply(read_film(supply))
    rib = Rib(lubrication=RibMixedFilm()) if rib_friction is None else Rib(friction=rib_friction)
    # no step needs the corner of friction at rest rounded
    rib = replace(rib, drilling=True, regularisation_speed=_SLOWEST)
    resistance = RollingResistance(regularisation_speed=_SLOWEST)

    def one(rpm: float) -> float:
        static = equilibrium(chosen, load_kN, end_play_mm=end_play_mm, speed_rpm=rpm, rings=rings)
        return running_torque(
            chosen,
            oil,
            kelvin,
            static,
            rpm * _RPM,
            resistance=resistance,
            supply=found,
            rib=rib,
        ).total

    return answer_each("speed_rpm", speed_rpm, one)


def life(
    bearing: RollerBearing | str,
    load_kN: Load = 80.0,
    speed_rpm: float = 1000.0,
    *,
    lubricant: Lubricant | str = "L055",
    temperature_C: float = 70.0,
    contamination: float | None = None,
    end_play_mm: float | None = None,
    radial_clearance_mm: float | None = None,
    tilt: Literal["locked", "free"] = "locked",
    rings: Literal["elastic", "rigid"] = "rigid",
) -> RatingLife:
    """Rate the life of a bearing under one load, ISO 281 and ISO 16281, basic and modified.

    Parameters
    ----------
    bearing, load_kN, end_play_mm, radial_clearance_mm, tilt
        See `equilibrium`.
    speed_rpm : float
        Of the shaft; it sets the film and with it the modified lives.
    lubricant : Lubricant or str
        Shipped lubricant or path of a YAML file.
    temperature_C : float
        Temperature of the lubricant, degrees Celsius. The bearing has it too.
    contamination : float, optional
        e_C of ISO 281, 0 to 1: 1 extreme cleanliness; default 0.6, sealed and greased.
    rings : str
        ``rigid``, as ISO 16281 defines its lives, or ``elastic``: under the loads of `equilibrium`.

    Returns
    -------
    RatingLife
        [revolutions].

    Raises
    ------
    InputError
        The shaft stands, or an argument makes no sense.
    """
    if not speed_rpm:
        raise InputError("speed_rpm is 0; life needs a shaft that turns")
    from beardyn_core.physics.statics.rating_life import USUAL_CONTAMINATION, LoadClass, rating_life

    cleanliness = USUAL_CONTAMINATION if contamination is None else contamination
    if problem := limit_problem("contamination", cleanliness):
        raise InputError(problem)
    chosen, end_play = find_with_play(bearing, end_play_mm, radial_clearance_mm)
    x, y, z = read_force(chosen, load_kN)
    rated = rating_life(
        chosen,
        (LoadClass(1.0, (x, y, z), (0.0, 0.0, 0.0), abs(read_shaft_speed(speed_rpm))),),
        find_lubricant(lubricant),
        read_temperature(temperature_C),
        end_play=end_play,
        tilt=tilt,
        contamination=cleanliness,
        rings=rings,
    )
    assert rated is not None
    return rated


def film(
    bearing: RollerBearing | str,
    speed_rpm: float,
    load_kN: Load = 80.0,
    *,
    lubricant: Lubricant | str = "L055",
    temperature_C: float = 70.0,
    supply: str = "settled",
    end_play_mm: float | None = None,
    rings: Literal["elastic", "rigid"] = "elastic",
) -> dict[str, Float]:
    """Give the smallest film of every roller on both raceways in pure rolling.

    Parameters
    ----------
    bearing, load_kN, end_play_mm, rings
        See `equilibrium`.
    speed_rpm : float
        Of the shaft.
    lubricant : Lubricant or str
    temperature_C : float
        At the inlets of the contacts.
    supply : str
        As in `torque`.

    Returns
    -------
    dict of str to float64 array, shape [row, roller]
        ``cup`` and ``cone``, [m]; NaN where a roller carries nothing. With the heat of the inlet; by
        ``bearing.raceway_roughness`` for the film parameter lambda.

    References
    ----------
    Dowson and Higginson (1966), Murch and Wilson (1975): see `beardyn_core.bearing.film_thickness`.
    """
    import numpy as np

    from beardyn_core.bearing.film_thickness import line_film, thermal_factor, thermal_loading
    from beardyn_core.bearing.oil_layer import layer_thickness, starved_film
    from beardyn_core.physics.lamina_table import equivalent_radius
    from beardyn_core.physics.statics.torque import entrainment_speeds

    chosen = find_with_lines(bearing, "films")
    oil, kelvin = find_lubricant(lubricant), read_temperature(temperature_C)
    static = equilibrium(chosen, load_kN, end_play_mm=end_play_mm, speed_rpm=speed_rpm, rings=rings)
    viscosity, found = oil.dynamic_viscosity(kelvin), {}
    oil_layer = read_film(supply).oil_layer
    speeds = entrainment_speeds(chosen, speed_rpm * _RPM)
    for ring, loads, speed in zip(("cup", "cone"), (static.cup_load, static.cone_load), speeds, strict=True):
        loading = thermal_loading(viscosity, oil.temperature_coefficient, speed, oil.thermal_conductivity)
        radius = float(equivalent_radius(chosen, np.zeros(1), ring)[0])
        films = np.full(loads.shape, np.nan)
        for place in zip(*np.nonzero(loads > 0.0), strict=True):
            films[place] = thermal_factor(loading, "murch_wilson") * line_film(
                float(loads[place]) / chosen.effective_length, speed, radius,
                chosen.material.contact_modulus, viscosity, oil.pressure_viscosity_at(kelvin),
            )  # fmt: skip
        if oil_layer is not None and speed > 0.0:
            films = starved_film(films, layer_thickness(oil_layer, viscosity, speed))
        found[ring] = films
    return found


def fault_frequencies(bearing: RollerBearing | str, speed_rpm: float | None = None) -> dict[str, float]:
    """Give FTF, BPFO, BPFI and BSF of one row.

    Parameters
    ----------
    bearing : Bearing or str
    speed_rpm : float, optional
        Of the shaft.

    Returns
    -------
    dict
        [Hz] at that speed, without one per revolution of the shaft. A roller fault strikes at 2 BSF.
    """
    from beardyn_core.bearing.kinematics import fault_frequencies as frequencies_per_rev

    hertz = 1.0 if speed_rpm is None else abs(read_shaft_speed(speed_rpm)) / (2.0 * math.pi)
    return {name: hertz * value for name, value in frequencies_per_rev(find_bearing(bearing)).by_name.items()}
