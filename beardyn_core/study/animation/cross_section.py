"""A row of rollers in cross-section: rings, rollers coloured by load, bars of load, spalls, shaft."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import Collection, EllipseCollection, LineCollection
from matplotlib.patches import Annulus

from beardyn_core.base.arrays import Float
from beardyn_core.record.description import BearingShape
from beardyn_core.record.load_colours import CONE_COLOUR, CUP_COLOUR, SPALL_COLOUR, load_colours
from beardyn_core.study.animation.row_motion import Moment, RowMotion
from beardyn_core.study.animation.spall_passages import RingSpall, spall_azimuth

LONGEST_BAR = 0.30  # of the outer radius
_BAR_FOOT = 1.04  # of the outer radius
_LEAST_SPALL = 0.045  # half the angle that is drawn at least, [rad]


def rgb(colour: tuple[int, int, int]) -> tuple[float, float, float]:
    """Give a colour as matplotlib takes it."""
    return colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0


class CrossSection:
    """A row across the bearing axis at the middle of the rollers, up and forward as +z and +x.

    Parameters
    ----------
    axes : Axes
    shape : BearingShape
    motion : RowMotion
    largest : float
        Roller load of the last colour and of the longest bar, [N].
    spalls : sequence of Patch or FieldSpall
        Of the rings in this row.
    """

    def __init__(
        self, axes: Axes, shape: BearingShape, motion: RowMotion, largest: float, spalls: list[RingSpall]
    ) -> None:
        self._present, self._largest = motion.present, max(largest, 1e-9)
        self._pitch, self._half = 0.5 * shape.pitch_diameter, 0.5 * shape.roller_diameter
        self._outer, self._bore = 0.5 * shape.outer_diameter, 0.5 * shape.bore
        self._cone_spalls = [each for each in spalls if each.on == "cone"]
        self._draw_rings(axes)
        for spall in spalls:
            if spall.on == "cup":
                axes.add_collection(self._spall_marks([spall], 0.0))
        diameters = np.full(int(self._present.sum()), 2.0 * self._half)
        self._rollers = EllipseCollection(
            diameters, diameters, np.zeros(len(diameters)), units="xy", offsets=np.zeros((len(diameters), 2)),
            offset_transform=axes.transData, edgecolors="0.25", linewidths=0.7,
        )  # fmt: skip
        self._marks = LineCollection([], colors="0.25", linewidths=1.0)
        self._bars = LineCollection([], linewidths=4.0, capstyle="butt")
        self._shaft = LineCollection([], colors="0.3", linewidths=2.5)
        self._turning_spalls = LineCollection([], colors=[rgb(SPALL_COLOUR)], linewidths=4.0)
        for each in self.moving:
            axes.add_collection(each)
        reach = (_BAR_FOOT + LONGEST_BAR) * self._outer
        axes.set(xlim=(-reach, reach), ylim=(-1.12 * self._outer, reach), aspect="equal")
        axes.set_axis_off()

    def draw_load(self, axes: Axes, load: Float) -> None:
        """Draw the force on the journal as an arrow from its centre.

        Parameters
        ----------
        axes : Axes
        load : array, shape [2]
            Forward and up, [N].
        """
        size = float(np.hypot(*load))
        if size == 0.0:
            return
        forward, up = (float(each) for each in 0.6 * self._bore * load / size)
        style = {"arrowstyle": "-|>", "color": "0.35", "lw": 2.0}
        axes.annotate("", (forward, up), (0.0, 0.0), arrowprops=style, zorder=1)
        text = f"load on the journal\n{1e-3 * size:.0f} kN"
        look: dict[str, Any] = {"ha": "center", "va": "center", "fontsize": 7, "color": "0.35", "zorder": 1}
        axes.text(-0.3 * forward, -0.3 * up, text, **look)

    @property
    def moving(self) -> list[Collection]:
        """List what changes from moment to moment, the lowest first."""
        return [self._shaft, self._bars, self._rollers, self._marks, self._turning_spalls]

    def show(self, moment: Moment) -> None:
        """Put everything where it is at a moment."""
        here = self._present
        azimuth, load = moment.azimuth[here], moment.load[here]
        colours = load_colours(load, self._largest) / 255.0
        centre = self._pitch * direction(azimuth)
        self._rollers.set_offsets(centre)
        self._rollers.set_facecolor(colours.tolist())
        spoke = 0.85 * self._half * direction(moment.spin[here])
        self._marks.set_segments(list(np.stack((centre, centre + spoke), axis=1)))
        foot = _BAR_FOOT * self._outer * direction(azimuth)
        reach = (LONGEST_BAR * self._outer * load / self._largest)[:, None] * direction(azimuth)
        self._bars.set_segments(list(np.stack((foot, foot + reach), axis=1)))
        self._bars.set_color(colours.tolist())
        turn = direction(np.array([moment.shaft]))
        self._shaft.set_segments([np.concatenate((0.72 * self._bore * turn, 0.98 * self._bore * turn))])
        self._turning_spalls.set_segments(
            [self._arc(each, float(spall_azimuth(each, moment.shaft))) for each in self._cone_spalls]
        )

    def _draw_rings(self, axes: Axes) -> None:
        gap = self._half
        cup, cone = self._outer - (self._pitch + gap), self._pitch - gap - self._bore
        axes.add_patch(Annulus((0.0, 0.0), self._outer, cup, fc=rgb(CUP_COLOUR), ec="0.3", lw=0.8))
        axes.add_patch(Annulus((0.0, 0.0), self._pitch - gap, cone, fc=rgb(CONE_COLOUR), ec="0.3", lw=0.8))
        axes.add_patch(Annulus((0.0, 0.0), self._bore, 0.999 * self._bore, fc="0.93", ec="0.3", lw=0.8))

    def _spall_marks(self, spalls: list[RingSpall], shaft: float) -> LineCollection:
        arcs = [self._arc(each, float(spall_azimuth(each, shaft))) for each in spalls]
        return LineCollection(arcs, colors=[rgb(SPALL_COLOUR)], linewidths=4.0, zorder=3)

    def _arc(self, spall: RingSpall, azimuth: float) -> Float:
        side = 1.0 if spall.on == "cup" else -1.0
        radius = self._pitch + side * (self._half + 0.0015)
        half = max(0.5 * spall.width / radius, _LEAST_SPALL)
        return radius * direction(np.linspace(azimuth - half, azimuth + half, 9))


def direction(azimuth: Float) -> Float:
    """Give the unit vectors of azimuths in the picture, x forward and z up, shape [..., 2]."""
    return np.stack((np.sin(azimuth), np.cos(azimuth)), axis=-1)
