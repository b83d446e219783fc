"""Curves, braking, starting and timetables as written under an operation."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from beardyn_core.config.file_model import FileModel, Friction, NonNegative, Number, Positive, problem
from beardyn_core.config.units import KMH, MM
from beardyn_core.scene.braking import Braking, Starting
from beardyn_core.scene.curve import Curve
from beardyn_core.scene.timetable import Stop, Timetable

Acceleration = Annotated[Positive, Field(ge=0.01, le=3.0)]
Wait = Annotated[Positive, Field(ge=0.5, le=3600.0)]


class CurveKeys(FileModel):
    """A circular arc between two transitions on which curvature and cant grow linearly."""

    radius_m: Annotated[Positive, Field(ge=50.0, le=1e5)]
    cant_mm: Annotated[Number, Field(ge=-50.0, le=250.0)] = Field(
        0.0, description="the outer rail above the inner one"
    )
    begin_m: Annotated[NonNegative, Field(le=1e6)] = Field(
        0.0, description="where the first transition begins, from the start of the run"
    )
    length_m: Annotated[Positive, Field(ge=2.0, le=1e5)] = Field(description="with both transitions")
    transition_m: Annotated[Positive, Field(ge=1.0, le=1e4)] = Field(description="length of each")
    hand: Literal["left", "right"] = Field(
        "left", description="where it turns; a left axlebox is on the inner rail of a left-hand curve"
    )

    @model_validator(mode="after")
    def _holds_its_transitions(self) -> Self:
        if 2.0 * self.transition_m > self.length_m:
            raise problem(
                f"transition_m is {self.transition_m:g}; it must be at most half of length_m, "
                f"{0.5 * self.length_m:g}"
            )
        return self

    def noun(self) -> Curve:
        """The curve, SI."""
        return Curve(
            self.radius_m, self.cant_mm / MM, self.begin_m, self.length_m, self.transition_m, self.hand
        )


class BrakingKeys(FileModel):
    """The brake of this axle; how much it brakes follows from the speed."""

    brake: Literal["disc", "block", "clasp"] = Field(
        "disc", description="on the axle, one block a wheel, or two blocks whose forces cancel"
    )
    share: Annotated[NonNegative, Field(le=10.0)] = Field(
        1.0, description="over what would brake this axle's own part of the vehicle"
    )
    friction: Annotated[Friction, Field(ge=0.05, le=0.6)] = Field(0.25, description="of block on wheel")
    disc_radius_mm: Annotated[Positive, Field(ge=100.0, le=600.0)] = 250.0
    ahead: bool = Field(True, description="whether caliper or block are ahead of the axle, at +x")

    def noun(self) -> Braking:
        """The brake, SI."""
        return Braking(self.brake, self.share, self.friction, self.disc_radius_mm / MM, self.ahead)


class StartingKeys(FileModel):
    """The drive of this axle; how much it drives follows from the speed."""

    share: Annotated[NonNegative, Field(le=20.0)] = Field(
        1.0, description="over what would speed up this axle's own part: 2 where half of the axles drive"
    )

    def noun(self) -> Starting:
        """The drive."""
        return Starting(self.share)


class StopKeys(FileModel):
    """One stop of a timetable."""

    distance_m: Annotated[Positive, Field(ge=1.0, le=1e6)] = Field(description="from the stop before")
    wait_s: Wait = 20.0
    top_speed_kmh: Annotated[Positive, Field(ge=1.8, le=400.0)] = Field(description="on the way to it")

    def noun(self) -> Stop:
        """The stop, SI."""
        return Stop(self.distance_m, self.wait_s, self.top_speed_kmh * KMH)


class TimetableKeys(FileModel):
    """A run from stop to stop that begins standing."""

    stops: Annotated[tuple[StopKeys, ...], Field(min_length=1)]
    acceleration_m_per_s2: Acceleration = 0.5
    deceleration_m_per_s2: Acceleration = 0.6
    wait_s: Wait = Field(1.0, description="before the first departure")

    def noun(self) -> Timetable:
        """The timetable, SI."""
        return Timetable(
            tuple(stop.noun() for stop in self.stops),
            self.acceleration_m_per_s2,
            self.deceleration_m_per_s2,
            self.wait_s,
        )
