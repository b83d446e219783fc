"""The published figures beside ours."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from beardyn_core.base.errors import ValidityError
from beardyn_core.bearing.kinematics import cage_speed
from beardyn_core.choice import load_scene
from beardyn_core.effects import ContactDamping
from beardyn_core.physics.statics.static import solve
from beardyn_core.scene.operation import ConstantOperation
from beardyn_core.scene.scene import Scene
from evidence.santos2017.friction import KINDS, Contacts, contacts_of, while_sliding, with_speed_jump
from evidence.santos2017.runs import SETTLED, STEP_AT, StepRecord, at_once, record
from evidence.santos2017.spectrum import (
    PUBLISHED_BAND,
    RADIAL_LOAD,
    SHAFT_SPEED,
    Bands,
    Variation,
    bands,
    variations,
)

QUARTER_TURN = 0.03  # [s]
LONGEST_RUN = 0.2  # published, under load [s]
HOURS = {"fsolve": 24.0, "Newton, numeric Jacobian": 8.0, "Newton, analytic Jacobian": 9.5}
AXIAL_FORCE = 2.0e3  # holds the loaded row
TOO_LITTLE = 1.2e3  # does not: its rollers thrust more than that
STANDARD_GRAVITY = 9.80665
_FULL_FILM = 1.5


@dataclass(frozen=True)
class Row:
    """One quantity.

    Parameters
    ----------
    quantity, published, ours, remark : str
        What, its value there and where it stands, ours, and what to think of it.
    """

    quantity: str
    published: str
    ours: str
    remark: str


@dataclass(frozen=True)
class SantosRuns:
    """Every run that is compared.

    Parameters
    ----------
    unloaded, loaded, step, lubricated, double_row, double_row_100kn : StepRecord
        The shipped scenes ``santos_*``.
    sudden, undamped : StepRecord
        ``santos_step`` with a load that comes on at once; the same without contact damping.
    jump : StepRecord
        ``santos_loaded`` with a jump of the shaft speed.
    held : StepRecord
        ``santos_loaded`` with a constant axial force of 2 kN instead of the prop.
    bands : tuple of Bands
        Spectra of the row with one change each.
    """

    unloaded: StepRecord
    loaded: StepRecord
    step: StepRecord
    lubricated: StepRecord
    double_row: StepRecord
    double_row_100kn: StepRecord
    sudden: StepRecord
    undamped: StepRecord
    jump: StepRecord
    held: StepRecord
    bands: tuple[Bands, ...]

    @property
    def thrust(self) -> float:
        """Mean axial force of the loaded row, which its prop carries, [N]."""
        return float(self.loaded.force[self.loaded.time >= SETTLED, 1].mean())


def run_all() -> SantosRuns:
    """Run everything: half a minute with compiled kernels."""
    loaded_scene, step_scene = load_scene("santos_loaded"), load_scene("santos_step")
    sudden = at_once(step_scene, RADIAL_LOAD, SHAFT_SPEED)
    finer = Variation("finer step", time_constant=ContactDamping().time_constant)
    return SantosRuns(
        unloaded=record(load_scene("santos_unloaded")),
        loaded=record(loaded_scene),
        step=record(step_scene),
        lubricated=record(load_scene("santos_lubricated")),
        double_row=record(load_scene("santos_double_row")),
        double_row_100kn=record(load_scene("santos_double_row_100kN")),
        sudden=record(finer.applied(step_scene), sudden),
        undamped=record(Variation("no damping").applied(step_scene), sudden),
        jump=record(with_speed_jump(loaded_scene)),
        held=record(held_by_a_force(loaded_scene, AXIAL_FORCE)),
        bands=tuple(bands(step_scene, variation) for variation in variations(step_scene)),
    )


def held_by_a_force(scene: Scene, axial: float) -> Scene:
    """Hold the loaded row by a constant axial force instead of the prop, for 0.06 s.

    Parameters
    ----------
    scene : Scene
        ``santos_loaded``.
    axial : float
        Presses the inner ring into the row, [N].
    """
    assert isinstance(scene.operation, ConstantOperation)
    operation = replace(scene.operation, force=(0.0, axial, RADIAL_LOAD))
    return replace(
        scene,
        operation=operation,
        mounting=replace(scene.mounting, axial_prop_stiffness=0.0, axial_prop_damping=0.0),
        duration=0.06,
    )


def refusal(axial: float = 0.0) -> str:
    """Return the refusal of the loaded row without prop under an axial force; empty when it is in balance.

    Parameters
    ----------
    axial : float
        [N].
    """
    scene = load_scene("santos_loaded")
    try:
        solve(scene.bearing, (0.0, axial, RADIAL_LOAD), end_play=scene.end_play, rows=1, speed=SHAFT_SPEED)
    except ValidityError as error:
        return str(error)
    return ""


def rows(runs: SantosRuns) -> Iterator[Row]:
    """Yield the rows of the table."""
    yield from _motion(runs)
    yield from _friction(runs)
    yield from _force(runs)
    yield from _double_row(runs)
    yield from _wall_time(runs)


def _motion(runs: SantosRuns) -> Iterator[Row]:
    turn = runs.unloaded.cage_turn(QUARTER_TURN) / (2.0 * np.pi)
    yield Row(
        "turn of the rollers about the axle in 0.03 s, no load",
        "about 1/4 (Section 7.1)",
        f"{turn:.4f}",
        "the text gives neither speed nor dimensions; 1165 rpm is what makes HS130x230 do this",
    )
    rib, cup = (contacts_of(runs.unloaded, kind) for kind in ("rib", "cup"))
    bearing = runs.unloaded.scene.bearing
    orbit = cage_speed(bearing, SHAFT_SPEED)
    weights = 0.5 * bearing.pitch_diameter * orbit**2 / STANDARD_GRAVITY
    yield Row(
        "where unloaded rollers go",
        "to the outer raceway, then until the large end meets the right flange (Section 7.1)",
        f"on cup and rib, {cup.normal.mean():.0f} N and {rib.normal.mean():.0f} N each",
        f"centrifugal force, {weights:.0f} times the weight, seats them from the first step",
    )
    turn = runs.loaded.cage_turn(LONGEST_RUN) / (2.0 * np.pi)
    yield Row(
        "turn of the rollers in the longest run, 0.2 s",
        "less than one revolution (Section 7.1)",
        f"{turn:.2f}",
        "does not go with a quarter turn in 0.03 s, which is 1.67 in 0.2 s: its two runs differ in speed, or "
        "one statement is off",
    )


def _friction(runs: SantosRuns) -> Iterator[Row]:
    unloaded = {kind: contacts_of(runs.unloaded, kind) for kind in KINDS}
    sliding = while_sliding(runs.jump, "cone")
    yield Row(
        "tangential over normal force, dry: sliding contacts",
        "10 % always (Section 7.1)",
        f"rib {_percent(unloaded['rib'].mean_ratio)}; cone raceway after a jump of the shaft speed "
        f"{_percent(sliding.mean_ratio)}",
        "the coefficient of friction itself, as it must be where something slides",
    )
    loaded = [contacts_of(runs.loaded, kind) for kind in ("cup", "cone")]
    yield Row(
        "the same: raceways while the rollers roll",
        "10 % always (Section 7.1)",
        f"{_percent(unloaded['cup'].mean_ratio)} unloaded; {_percent(loaded[0].mean_ratio)} (cup), "
        f"{_percent(loaded[1].mean_ratio)} (cone) under 5 kN",
        "a rolling roller needs only what ribs and pockets take from it; all contacts at the limit at once "
        "is what friction without a slope at zero slip gives when it flips from step to step",
    )
    oil = [contacts_of(runs.lubricated, kind) for kind in ("cup", "cone")]
    yield Row(
        "film parameter with the oil EP 220 under 5 kN",
        'not printed; "dry", the oil "not suitable" (Section 7.1)',
        f"{_least_film(oil):.1f} to {max(float(each.film_parameter.max()) for each in oil):.1f} at 70 °C",
        f"above the {_FULL_FILM:g} from which its own Eq. (8) takes the full film: at this load and speed "
        "the oil separates the surfaces; by this the dry result is a defect of the computation",
    )
    yield Row(
        "tangential over normal force, lubricated, raceways",
        "10 % (Section 7.1)",
        f"{_percent(oil[0].mean_ratio)} (cup), {_percent(oil[1].mean_ratio)} (cone); "
        f"99 % of contacts below {_percent(max(float(np.quantile(each.ratio, 0.99)) for each in oil))}",
        "Eq. (8) with its own limits; full film allows at most 2 %",
    )


def _force(runs: SantosRuns) -> Iterator[Row]:
    yield Row(
        "axial support of the single row under 5 kN",
        "an axial force on the inner raceway, no value (Section 7.1)",
        f"{runs.thrust / 1e3:.2f} kN carried by the prop; a constant {AXIAL_FORCE / 1e3:g} kN instead holds "
        f"the ring within {runs.held.axial_range * 1e6:.1f} µm",
        f"there is no balance without support, nor with {TOO_LITTLE / 1e3:g} kN; such scenes are refused "
        "with a sentence",
    )
    force = runs.step.radial_after(STEP_AT + SETTLED)
    yield Row(
        "mean force on the inner raceway 0.01 s after the load",
        "5 kN (Fig. 6(a))",
        f"{force.mean() / 1e3:.3f} kN, standard deviation {force.std():.0f} N",
        "Newton's second law: any code that is stable must give it",
    )
    yield Row(
        "largest force after the load comes on",
        "not printed; the axis of Fig. 6(a) ends at 30 kN",
        f"{_peak(runs.step)} within 0.5 ms; {_peak(runs.sudden)} at once, {_peak(runs.undamped)} without "
        "contact damping",
        "a load put on at once doubles; much more needs rings that start apart or overlapping, where ours "
        "starts from the static equilibrium",
    )
    plain = runs.bands[0]
    yield Row(
        "band of the force spectrum",
        f"around {PUBLISHED_BAND / 1e3:g} kHz (Fig. 6(b))",
        f"{_kilo(plain.found[0])} and {_kilo(plain.found[1])} kHz without contact damping; none with it",
        "rollers bounce on their contacts, see below",
    )


def _double_row(runs: SantosRuns) -> Iterator[Row]:
    for run, load in ((runs.double_row, 5.0), (runs.double_row_100kn, 100.0)):
        force = run.radial_after(SETTLED)
        yield Row(
            f"double row under {load:g} kN, no prop",
            "announced as necessary, not done (Section 8)",
            f"{force.mean() / 1e3:.3f} kN; inner ring within {run.axial_range * 1e6:.2f} µm along the axle",
            "the rows hold each other" if load < 10.0 else "twenty times the load of its run",
        )


def _wall_time(runs: SantosRuns) -> Iterator[Row]:
    seconds = runs.unloaded.wall_time * QUARTER_TURN / runs.unloaded.time[-1]
    times = ", ".join(f"{hours:g} h ({name})" for name, hours in HOURS.items())
    yield Row(
        "wall time of 0.03 s, single row",
        f"{times} (Table 1)",
        f"{seconds:.2f} s",
        f"{_round(min(HOURS.values()) * 3600.0 / seconds)} to "
        f"{_round(max(HOURS.values()) * 3600.0 / seconds)} times less; other computer and language, "
        "closed forms instead of a search for each contact, fixed step instead of ODE45, friction solved "
        "implicitly",
    )
    run = runs.double_row
    yield Row(
        "wall time of 0.2 s, double row, film computed",
        "not done",
        f"{run.wall_time * LONGEST_RUN / run.time[-1]:.1f} s",
        f"{run.scene.roller_total} rollers and two cages",
    )


def _percent(ratio: float) -> str:
    return f"{100.0 * ratio:.1f} %"


def _kilo(value: float) -> str:
    return f"{value / 1e3:.1f}"


def _peak(run: StepRecord) -> str:
    return f"{run.force[:, 2].max() / 1e3:.1f} kN"


def _least_film(contacts: list[Contacts]) -> float:
    return min(float(each.film_parameter.min()) for each in contacts)


def _round(value: float) -> str:
    """Write a number with two significant digits."""
    return f"{float(f'{value:.1e}'):,.0f}"
