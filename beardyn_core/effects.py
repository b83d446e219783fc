"""The catalogue of effects: what each adds, what it costs, where it holds; and sets of them.

An effect is present when its member of `EffectSet` is an options object and absent when the member is
``None``; the kernels are compiled for the members that are present.
"""

from __future__ import annotations

from dataclasses import dataclass, fields


@dataclass(frozen=True)
class ContactDamping:
    """Velocity-proportional loss of raceway and rib contacts.

    Parameters
    ----------
    time_constant : float
        Damping force over tangent stiffness and normal velocity, [s].
    """

    time_constant: float = 5e-6


@dataclass(frozen=True)
class CoulombTraction:
    """Dry friction, regularised over a slip speed.

    Parameters
    ----------
    friction : float
        Coefficient of friction at full slip.
    regularisation_speed : float
        Slip speed at which 71 % of the friction is reached, [m/s].
    """

    friction: float = 0.1
    regularisation_speed: float = 0.01


@dataclass(frozen=True)
class MixedTraction:
    """Boundary and full-film friction blended over the film parameter, both regularised.

    Parameters
    ----------
    boundary_friction : float
        Coefficient of friction of the dry asperities.
    full_film_friction : float
        Coefficient of friction of the lubricant film at full slip.
    regularisation_speed : float
        Slip speed at which 71 % of the friction is reached, [m/s].
    boundary_film_parameter : float
        Film parameter below which all load is carried by asperities.
    full_film_parameter : float
        Film parameter above which all load is carried by the film.
    """

    boundary_friction: float = 0.1
    full_film_friction: float = 0.02
    regularisation_speed: float = 0.02
    boundary_film_parameter: float = 0.01
    full_film_parameter: float = 1.5


@dataclass(frozen=True)
class ShearedFilmTraction:
    """The blend of `MixedTraction` with a film that shears: Newtonian up to a limiting shear stress.

    Light contacts have almost no traction then, so the bearing can skid as a real one does.

    Parameters
    ----------
    boundary_friction, regularisation_speed, boundary_film_parameter, full_film_parameter : float
        As in `MixedTraction`.
    limiting_shear : float
        Limiting shear stress of the lubricant over the mean contact pressure.
    """

    boundary_friction: float = 0.1
    regularisation_speed: float = 0.02
    boundary_film_parameter: float = 0.01
    full_film_parameter: float = 1.5
    limiting_shear: float = 0.045


Traction = CoulombTraction | MixedTraction | ShearedFilmTraction


@dataclass(frozen=True)
class LineFilm:
    """Elastohydrodynamic film of the raceway line contacts.

    Parameters
    ----------
    starvation : float
        Film thickness over the fully flooded one, 0 to 1.
    """

    starvation: float = 0.7


@dataclass(frozen=True)
class Rib:
    """Contact of the spherical large roller end with the conical cone rib.

    Parameters
    ----------
    friction : float
        Coefficient of friction of the rib contact.
    regularisation_speed : float
        Slip speed at which 71 % of the friction is reached, [m/s].
    """

    friction: float = 0.05
    regularisation_speed: float = 0.05


@dataclass(frozen=True)
class Cage:
    """Cage of each row as a rigid body, touched by every roller in its pocket.

    Parameters
    ----------
    friction : float
        Coefficient of friction between roller and pocket.
    regularisation_speed : float
        Slip speed at which 71 % of the friction is reached, [m/s].
    bar_inclination : float
        Angle of the bar faces against the radial plane: the bars stand outside the pitch circle, so the
        rollers also guide the cage radially, [rad].
    initial_speed_ratio : float
        Cage and roller orbit speed at the start over the kinematic one.
    """

    friction: float = 0.08
    regularisation_speed: float = 0.1
    bar_inclination: float = 0.44
    initial_speed_ratio: float = 1.0


@dataclass(frozen=True)
class Gravity:
    """Weight of rollers, cages and axlebox.

    Parameters
    ----------
    acceleration : float
        Acceleration of free fall, [m/s^2].
    """

    acceleration: float = 9.80665


@dataclass(frozen=True)
class Audit:
    """Energy balance kept while the model runs."""


@dataclass(frozen=True)
class EffectSet:
    """Which effects a scene simulates, and their options; ``None`` is absent at no cost.

    Faults are not listed: they are present when the scene has defects.
    """

    contact_damping: ContactDamping | None = ContactDamping()
    traction: Traction | None = MixedTraction()
    film: LineFilm | None = LineFilm()
    rib: Rib | None = Rib()
    cage: Cage | None = Cage()
    gravity: Gravity | None = Gravity()
    audit: Audit | None = Audit()

    def names(self) -> tuple[str, ...]:
        """Names of the effects that are present, in the order of the catalogue."""
        return tuple(field.name for field in fields(self) if getattr(self, field.name) is not None)
