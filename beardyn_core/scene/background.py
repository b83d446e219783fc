"""What sensors on real axleboxes receive besides the bearing: forces on the journal, and pickup."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.base.edge import At
from beardyn_core.scene.excitation import RAIL_LEVELS

WHEELS = ("smooth", "disc_brake", "composite", "cast_iron", "none")
FAULTS = ("cup", "cone", "roller")
# between two samples of a load with a background, which reaches 8 kHz
BACKGROUND_SAMPLE_NS = 50_000
FORCE = At("kN", ge=0.0, le=20.0)


@dataclass(frozen=True)
class Roughness:
    """Short waves of wheel and rail, 4 mm to 2 m, which excite wheel and track to 5 kHz and above.

    References
    ----------
    Levels in third octaves of the wavelength: Directive (EU) 2015/996 (CNOSSOS-EU), table G-1; `iso_3095` is
    the limit of ISO 3095:2013 for test tracks; `good` and `smooth` are those of French high-speed lines and
    of wheels with composite blocks and discs (SNCF, 2021). The contact patch smooths both as it does the
    irregularity.
    """

    rail: A[
        str,
        At(one_of=RAIL_LEVELS),
        "level of the rail: of a good line, the limit of test tracks, of an average network",
    ] = "iso_3095"
    wheel: A[
        str, At(one_of=WHEELS), "level of the wheel, by its brakes; smooth: composite blocks and discs"
    ] = "disc_brake"


@dataclass(frozen=True)
class Drive:
    """Gear mesh and traction motor of a driven axle, as vertical forces on the journal."""

    teeth: A[int, At(ge=10, le=300), "of the gear wheel on the axle"]
    gear_ratio: A[float, At(gt=0.0, ge=1.0, le=12.0), "turns of the motor for one of the axle"]
    mesh_force: A[
        tuple[float, ...],
        FORCE,
        At(size=(1, 10)),
        "amplitude of the mesh order and its harmonics, one journal",
    ]
    motor_orders: A[tuple[float, ...], At(gt=0.0, le=200.0, size=(0, 20)), "per turn of the motor"] = ()
    motor_force: A[tuple[float, ...], FORCE, At(size=(0, 20)), "amplitude of each motor order"] = ()

    def rules(self) -> Iterator[str]:
        """Check that every motor order has its force."""
        if len(self.motor_orders) != len(self.motor_force):
            yield (
                f"motor_force_kN has {len(self.motor_force)} entries and motor_orders "
                f"{len(self.motor_orders)}; give one force for each order"
            )

    @property
    def orders(self) -> tuple[tuple[float, float], ...]:
        """Orders per turn of the axle and amplitudes [N]."""
        mesh = [(float(self.teeth * k), force) for k, force in enumerate(self.mesh_force, start=1)]
        motor = [
            (order * self.gear_ratio, force)
            for order, force in zip(self.motor_orders, self.motor_force, strict=True)
        ]
        return (*mesh, *motor)


@dataclass(frozen=True)
class OtherBearing:
    """The bearing at the other end of the axle, same type: what of its forces comes through."""

    passing_force: A[
        tuple[float, ...],
        FORCE,
        At(size=(1, 10)),
        "amplitude of the rollers' passing and its harmonics, as it comes to this journal",
    ]
    fault: A[str | None, At(one_of=FAULTS), "which of its parts is spalled; healthy when left out"] = None
    impulse: A[float, At("N_s", ge=0.0, le=10.0), "of each stroke of that fault, as it comes here"] = 0.0
    pulse: A[float, At("us", ge=100.0, le=5000.0), "length of a stroke, half a sine"] = 300.0e-6
    slip: A[
        float,
        At("percent", ge=0.0, le=5.0),
        "its cage's deviation from pure rolling; rollers and strokes follow",
    ] = 0.001

    def rules(self) -> Iterator[str]:
        """Check that a fault strikes, and that strokes have a fault."""
        if (self.fault is not None) != (self.impulse > 0.0):
            yield "fault and impulse_N_s go together: give both or none"


@dataclass(frozen=True)
class Knocks:
    """Random knocks of the running gear: a Poisson process, impulses with a lognormal distribution."""

    rate: A[float, At("Hz", gt=0.0, le=200.0), "how many a second, on average"]
    impulse: A[float, At("N_s", gt=0.0, le=50.0), "median of the impulses"]
    spread: A[float, At(ge=0.0, le=2.0), "standard deviation of the impulse's natural logarithm"] = 0.6
    pulse: A[float, At("us", ge=100.0, le=5000.0), "length of a knock, half a sine"] = 300.0e-6


@dataclass(frozen=True)
class PickupLine:
    """A pair of side bands around a multiple of the switching frequency."""

    carrier: A[int, At(ge=0, le=20), "multiple of the switching frequency"]
    side: A[int, At(ge=0, le=20), "multiple of the motor's electrical frequency, on either side"]
    amplitude: A[float, At("mV", ge=0.0, le=1000.0), "of each of the two, at the input of the recorder"]


@dataclass(frozen=True)
class Pickup:
    """What the inverter's currents induce in the sensor's cable: no force, added to the sensor's volts.

    References
    ----------
    Holmes, Lipo (2003), Pulse Width Modulation for Power Converters, chapter 3: side bands of sinusoidal
    modulation at even multiples of the electrical frequency around odd multiples of the switching frequency,
    and at odd ones around even multiples.
    """

    switching: A[float, At("Hz", gt=0.0, ge=100.0, le=50_000.0, key="switching_frequency"), "of the inverter"]
    electrical_order: A[
        float, At(gt=0.0, le=200.0), "electrical periods in a turn of the axle: pole pairs times gear ratio"
    ]
    lines: A[tuple[PickupLine, ...], At(size=(1, 20)), "side bands"]


@dataclass(frozen=True)
class Background:
    """What a sensor in service receives besides its bearing; each part is absent when left out."""

    name: A[str, At(longest=80), "of the background"]
    description: A[str, At(usual=""), "what it is, in a few words"]
    roughness: A[Roughness | None, "short waves of wheel and rail; needs an operation on the rail"] = None
    drive: A[Drive | None, "gear and motor of a driven axle"] = None
    other_bearing: A[OtherBearing | None, "of the same wheelset"] = None
    knocks: A[Knocks | None, "of the running gear"] = None
    pickup: A[Pickup | None, "electrical, in the sensors' cables"] = None
    amplitude_factor: A[
        float,
        At(ge=0.0, le=100.0),
        "on roughness and every force, not on the pickup: for a train that is louder or quieter",
    ] = 1.0
    sources: tuple[tuple[str, str], ...] = ()

    def __repr__(self) -> str:
        """Give the name and what there is, in one line."""
        parts = ("roughness", "drive", "other_bearing", "knocks", "pickup")
        received = ", ".join(part for part in parts if getattr(self, part) is not None)
        return f"Background {self.name}: {received or 'nothing'}"

    @property
    def forces(self) -> bool:
        """Whether anything in it is a force."""
        return any(part is not None for part in (self.roughness, self.drive, self.other_bearing, self.knocks))
