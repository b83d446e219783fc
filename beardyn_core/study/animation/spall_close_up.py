"""Rollers that pass a spall, magnified: both raceways as straight lines, the spall in the middle."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import Collection, EllipseCollection, LineCollection

from beardyn_core.base.arrays import Float
from beardyn_core.record.description import BearingShape
from beardyn_core.record.load_colours import CONE_COLOUR, CUP_COLOUR, SPALL_COLOUR, load_colours
from beardyn_core.study.animation.cross_section import rgb
from beardyn_core.study.animation.row_motion import Moment, RowMotion
from beardyn_core.study.animation.spall_passages import TURN, RingSpall, spall_azimuth

_REACH = 1.25  # roller pitches to either side
_DEPTH = 0.16  # drawn depth of the spall over the roller diameter: true depths cannot be seen
_MM = 1e3


class SpallCloseUp:
    """The neighbourhood of a spall, seen along the bearing axis and unrolled.

    Parameters
    ----------
    axes : Axes
    shape : BearingShape
    motion : RowMotion
    largest : float
        Roller load of the last colour, [N].
    spall : Patch or FieldSpall
        Of a ring in this row.
    """

    def __init__(
        self, axes: Axes, shape: BearingShape, motion: RowMotion, largest: float, spall: RingSpall
    ) -> None:
        self._spall, self._present, self._largest = spall, motion.present, max(largest, 1e-9)
        self._radius = 0.5 * _MM * shape.pitch_diameter
        diameter = _MM * shape.roller_diameter
        reach = _REACH * TURN * self._radius / shape.roller_count
        self._reach, self._diameter = reach, diameter
        self._draw_raceways(axes, diameter, _MM * spall.width)
        self._rollers = EllipseCollection(
            [diameter], [diameter], [0.0], units="xy", offsets=np.zeros((1, 2)),
            offset_transform=axes.transData, edgecolors="0.25", linewidths=1.0,
        )  # fmt: skip
        self._marks = LineCollection([], colors="0.25", linewidths=1.5)
        for each in self.moving:
            axes.add_collection(each)
        edge = 0.5 * diameter + 1.9 * _DEPTH * diameter
        axes.set(xlim=(-reach, reach), ylim=(-edge, edge), aspect="equal", yticks=[])
        axes.set_xlabel("along the raceway, from the middle of the spall [mm]", fontsize=8)
        axes.tick_params(labelsize=8)
        on = "outer ring (cup)" if spall.on == "cup" else "inner ring (cone)"
        axes.set_title(f"spall on the {on}, depth not to scale", fontsize=9)

    @property
    def moving(self) -> list[Collection]:
        """List what changes from moment to moment, the lowest first."""
        return [self._rollers, self._marks]

    def show(self, moment: Moment) -> None:
        """Put the rollers where they are at a moment."""
        away = moment.azimuth - float(spall_azimuth(self._spall, moment.shaft))
        place = self._radius * (np.mod(away + 0.5 * TURN, TURN) - 0.5 * TURN)
        near = self._present & (np.abs(place) < self._reach + 0.5 * self._diameter)
        centre = np.stack((place[near], np.zeros(int(near.sum()))), axis=1)
        self._rollers.set_offsets(centre)
        self._rollers.set_facecolor((load_colours(moment.load[near], self._largest) / 255.0).tolist())
        turned = moment.spin[near] - moment.azimuth[near]  # against the radius, which is upright here
        spoke = 0.42 * self._diameter * np.stack((np.sin(turned), np.cos(turned)), axis=1)
        self._marks.set_segments(list(np.stack((centre, centre + spoke), axis=1)))

    def _draw_raceways(self, axes: Axes, diameter: float, width: float) -> None:
        for side, colour, name in ((1.0, CUP_COLOUR, "cup"), (-1.0, CONE_COLOUR, "cone")):
            x, y = _raceway(self._reach, width if self._spall.on == name else 0.0, _DEPTH * diameter)
            level = side * (0.5 * diameter + y)
            axes.fill_between(x, level, side * diameter, color=rgb(colour), lw=0)
            axes.plot(x, level, color="0.3", lw=1.0)
            if self._spall.on == name:
                inside = np.abs(x) <= 0.5 * width
                axes.plot(x[inside], level[inside], color=rgb(SPALL_COLOUR), lw=2.5)


def _raceway(reach: float, width: float, depth: float) -> tuple[Float, Float]:
    """Give a raceway with a pit in its middle, or a whole one for a width of 0, as places and depths."""
    if width == 0.0:
        return np.array([-reach, reach]), np.zeros(2)
    half = 0.5 * width
    x = np.array([-reach, -half, -half, half, half, reach])
    return x, np.array([0.0, 0.0, depth, depth, 0.0, 0.0])
