"""Pictures of the contact laboratory. Need no screen."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from beardyn_core.base.arrays import Float
from beardyn_core.base.outputs import as_a_whole
from beardyn_core.laboratory import nine_contacts
from beardyn_core.laboratory.findings import Findings
from beardyn_core.laboratory.rolling import PLACE, Rolling

DPI = 100
_ROLLER, _CUP, _CONE, _CAGE = "#DD8452", "#4C72B0", "#55A868", "#8172B3"
_POINT = "#C44E52"
_ONE_OVER_ANOTHER = ((4.0, "-"), (2.2, "--"), (1.2, ":"))  # widths and styles of curves that coincide
_MM = 1e3


def _figure(width: float, height: float) -> Figure:
    return Figure(figsize=(width, height), dpi=DPI, layout="constrained")


def write_pictures(found: Findings, folder: Path, *, replace: bool = True) -> None:
    """Write all pictures to a folder; `replace` those that are there."""
    figures = {
        "contacts_nine.png": nine_figure(found),
        "contacts_sphere.png": sphere_figure(found),
        "contacts_rolling.png": rolling_figure(found),
        "contacts_barrel.png": barrel_figure(found),
    }
    for name, figure in figures.items():
        with as_a_whole(folder / name, replace=replace) as fresh:
            figure.savefig(fresh, dpi=DPI, format="png")


def _along_roller(found: Findings, points: Float) -> tuple[Float, Float, Float]:
    """Return places along the roller axis from mid-length, square to it (outwards), and around, [mm]."""
    axis = nine_contacts.nominal_axis(found.bearing)
    outward = np.array([axis[2], 0.0, -axis[0]])
    arm = np.asarray(points, dtype=float) - nine_contacts.nominal_centre(found.bearing)
    return _MM * (arm @ axis), _MM * (arm @ outward), _MM * arm[..., 1]


def nine_figure(found: Findings) -> Figure:
    """Draw the roller with its partners and the contact points: meridian plane, and from the outside."""
    figure = _figure(12.0, 5.2)
    left, right = figure.subplots(1, 2, width_ratios=(1.45, 1.0))
    _meridian(left, found)
    _from_outside(right, found)
    figure.suptitle(
        f"{found.bearing.name}: nine contacts at the first time step, points of the general search",
        fontsize=11,
    )
    return figure


def _roller(axes: Axes, found: Findings, label: str | None = None) -> float:
    """Draw the outline of the roller; return its half height, [mm]."""
    bearing = found.bearing
    half, large, small = 0.5 * bearing.roller_length, bearing.large_end_radius, bearing.small_end_radius
    turn = np.linspace(-1.0, 1.0, 41) * math.asin(large / bearing.sphere_radius)
    along = bearing.sphere_centre + bearing.sphere_radius * np.cos(turn)
    across = bearing.sphere_radius * np.sin(turn)
    x = _MM * np.concatenate([[-half], along, [-half, -half]])
    y = _MM * np.concatenate([[-small], across, [small, -small]])
    axes.fill(x, y, color=_ROLLER, alpha=0.25, lw=0)
    axes.plot(x, y, color=_ROLLER, lw=1.5, label=label)
    return float(y.max())


def _draw_line(axes: Axes, found: Findings, points: Float, colour: str, label: str | None = None) -> None:
    along, across, _ = _along_roller(found, points)
    axes.plot(along, across, color=colour, lw=2.5, label=label, solid_capstyle="round")


def _meridian(axes: Axes, found: Findings) -> None:
    bearing = found.bearing
    top = _roller(axes, found, "roller")
    reach = np.linspace(-0.56, 0.56, 2)[:, None] * bearing.roller_length
    axis, centre = nine_contacts.nominal_axis(bearing), nine_contacts.nominal_centre(bearing)
    outward = np.array([axis[2], 0.0, -axis[0]])
    for side, colour, label in ((1.0, _CUP, "cup"), (-1.0, _CONE, "cone with ribs")):
        radius = (bearing.apex_distance + reach) * math.tan(bearing.half_angle)
        _draw_line(axes, found, centre + reach * axis + side * radius * outward, colour, label)
    # the face of the large rib is given at its contact height
    for face, foot, height in (
        (nine_contacts.large_rib(bearing), -bearing.rib_contact_height, bearing.rib_height),
        (nine_contacts.small_rib(bearing), 0.0, bearing.small_rib_height),
    ):
        start = np.array([face.radial, 0.0, face.axial])
        along = np.array([face.normal_axial, 0.0, -face.normal_radial])
        along = along if along[0] > 0.0 else -along
        _draw_line(axes, found, start + np.array([[foot], [foot + height]]) * along, _CONE)
    for name, entry in (("C2.1", "cage lines"), ("C4.1", None)):
        along_axis, _, _ = _along_roller(
            found, nine_contacts.pocket_line(bearing, name).place.origin[None, :]
        )
        axes.plot(along_axis, [0.0], marker="s", ms=8, color=_CAGE, ls="", label=entry)
    _mark(axes, found, 1, ("Inner", "Outer", "FR", "FL", "C2.1"))
    axes.set(xlabel="along the roller axis [mm]", ylabel="square to it, outwards [mm]", aspect="equal")
    axes.set_title("meridian plane", fontsize=10)
    axes.set_ylim(-1.75 * top, 1.75 * top)
    axes.legend(loc="lower center", ncols=4, fontsize=8, frameon=False)


def _from_outside(axes: Axes, found: Findings) -> None:
    bearing = found.bearing
    top = _roller(axes, found)
    length, width = 0.5 * bearing.roller_length, bearing.large_end_radius
    for name, half in (("C3.1", length), ("C3.2", length), ("C2.1", width), ("C4.1", width)):
        place = nine_contacts.pocket_line(bearing, name).place
        along, _, around = _along_roller(found, place.origin + np.array([[-half], [half]]) * place.pole)
        axes.plot(along, around, color=_CAGE, lw=2.5)
    _mark(axes, found, 2, ("C2.1", "C3.1", "C3.2", "C4.1", "C4.2"))
    axes.set(xlabel="along the roller axis [mm]", ylabel="around the bearing [mm]", aspect="equal")
    axes.set_xlim(-1.3 * _MM * length, 1.3 * _MM * length)
    axes.set_title("seen from outside: cage pocket", fontsize=10)
    axes.set_ylim(-1.45 * top, 1.45 * top)


def _mark(axes: Axes, found: Findings, across: int, names: tuple[str, ...]) -> None:
    """Mark and name contact points: along the roller, and a coordinate of `_along_roller` across it."""
    assert set(names) <= set(nine_contacts.NAMES)
    labelled: set[str] = set()
    for contact in found.located:
        if contact.name not in names:
            continue
        # points of both shapes lie microns apart; the mark is on the roller's neighbour or on the roller
        coordinates = _along_roller(found, np.array([contact.q]))
        x, y = float(coordinates[0][0]), float(coordinates[across][0])
        axes.plot([x], [y], marker="o", ms=5, color=_POINT, zorder=5)
        if contact.name not in labelled:
            labelled.add(contact.name)
            offset = (8, 9 if y >= 0.0 else -15) if contact.name not in ("C2.1", "FR") else (9, -4)
            axes.annotate(
                contact.name, (x, y), textcoords="offset points", xytext=offset, fontsize=9, color=_POINT
            )


def sphere_figure(found: Findings) -> Figure:
    """Draw roller ends of growing radius: height of the contact, and the gap each method gives."""
    bearing = found.bearing
    figure = _figure(11.0, 4.4)
    left, right = figure.subplots(1, 2, width_ratios=(1.2, 1.0))
    ratios = np.array([case.ratio for case in found.spheres])
    low = -6.0
    left.axhspan(
        _MM * bearing.rib_undercut, _MM * bearing.rib_height, color=_CONE, alpha=0.18, label="rib face"
    )
    left.axhline(_MM * bearing.roller_chamfer, color=_ROLLER, ls="--", lw=1.2, label="rim of the roller end")
    heights = _MM * np.array([case.search_height for case in found.spheres])
    left.plot(ratios, np.maximum(heights, low), "o-", color=_POINT, label="general search")
    for ratio, height in zip(ratios, heights, strict=True):
        if height < low:
            left.annotate(
                f"{height:.0f} mm", (ratio, low), textcoords="offset points", xytext=(6, 3), fontsize=8
            )
    bounded = _MM * np.array([case.bounded_height for case in found.spheres])
    left.plot(ratios, bounded, "s-", color=_CUP, ms=4, label="closed form with edges and rim")
    ratio_label = "sphere radius over distance to the apex"
    left.set(xlabel=ratio_label, ylabel="height of the contact over the raceway [mm]")
    # a contact point counts that lies on both parts
    real = [case.search_gap if case.on_face and case.in_rim else 0.0 for case in found.spheres]
    depths = [1e6 * max(-gap, 0.0) for gap in real]
    bounded_depths = [1e6 * case.bounded_depth for case in found.spheres]
    places, width = np.arange(len(ratios)), 0.3
    right.bar(places - width / 2, depths, width, color=_POINT, label="general search")
    right.bar(places + width / 2, bounded_depths, width, color=_CUP, label="closed form with edges and rim")
    right.set_xticks(places, [f"{ratio:.2f}" for ratio in ratios])
    right.set(xlabel=ratio_label, ylabel="depth that makes a force on the part [µm]")
    right.set_ylim(0.0, 1.25 * max(*depths, *bounded_depths, 1e-9))
    left.legend(fontsize=8, frameon=False, loc="lower left")
    right.legend(fontsize=8, frameon=False, loc="upper right", ncols=2)
    figure.suptitle("A roller end on a given rib, pushed in by 10 µm", fontsize=11)
    return figure


def rolling_figure(found: Findings) -> Figure:
    """Draw coin and roller in the trough: where they are, how high, where the energy is."""
    figure = _figure(12.0, 4.4)
    left, middle, right = figure.subplots(1, 3, width_ratios=(1.5, 1.0, 1.0))
    coin, roller = found.rolling[0], found.rolling[-1]
    _positions(left, coin)
    for run, (width, style) in zip(found.rolling, _ONE_OVER_ANOTHER, strict=False):
        label = f"{run.body.name.split(',')[0]}, v_r {run.trough.transition_speed * 1e3:g} mm/s"
        middle.plot(run.time, _MM * run.height, lw=width, ls=style, label=label)
    middle.axhline(_MM * coin.height[0], color="0.6", lw=0.8, ls="--")
    middle.set(xlabel="time [s]", ylabel="height of the centre [mm]", ylim=(0.0, 1.35 * _MM * coin.height[0]))
    middle.legend(fontsize=8, frameon=False, loc="upper center")
    energies = roller.energies
    motion = energies["kinetic"] + energies["potential"] + energies["elastic"]
    lost, both = motion[0] - motion, energies["friction"] + energies["damping"]
    right.plot(roller.time, 1e6 * lost, color=_CUP, lw=3.0, alpha=0.5, label="energy of motion lost")
    right.plot(roller.time, 1e6 * both, color=_POINT, lw=1.0, ls="--", label="friction and damping")
    right.plot(roller.time, 1e6 * energies["damping"], color=_CONE, lw=1.0, label="damping alone")
    right.set(xlabel="time [s]", ylabel="roller [µJ]")
    right.legend(fontsize=8, frameon=False, loc="upper left")
    figure.suptitle("Rolling down a cylindrical floor and up again", fontsize=11)
    return figure


def _positions(axes: Axes, run: Rolling) -> None:
    angles, floor = np.linspace(-0.9, 0.9, 91), _MM * run.trough.radius
    axes.plot(floor * np.sin(angles), -floor * np.cos(angles), color="0.35")
    ring = np.linspace(0.0, 2.0 * math.pi, 49)
    last = run.turning_sample
    for sample in np.unique(np.linspace(0, last, 12).astype(int)):
        x, y = run.history[sample, PLACE : PLACE + 2]
        right, up = x + run.body.radius * np.cos(ring), y + run.body.radius * np.sin(ring)
        axes.plot(_MM * right, _MM * up, color=_ROLLER, alpha=0.25 + 0.75 * sample / max(last, 1), lw=1.2)
    axes.set(xlabel="x [mm]", ylabel="y [mm]", aspect="equal")
    axes.set_title("coin, evenly in time until it turns", fontsize=10)


def barrel_figure(found: Findings) -> Figure:
    """Draw the load distribution of the barrel roller bearing, and its cross-section with the contacts."""
    figure = _figure(10.0, 4.2)
    left, right = figure.subplots(1, 2)
    for loads, colour in zip(found.barrel_loads, (_CUP, _CONE, _ROLLER, _POINT), strict=False):
        azimuth = np.degrees((loads.azimuth + math.pi) % (2.0 * math.pi) - math.pi)
        order = np.argsort(azimuth)
        left.plot(azimuth[order], loads.formula[order] / 1e3, color=colour, lw=1.2)
        name = f"{loads.force / 1e3:g} kN"
        left.plot(azimuth[order], loads.load[order] / 1e3, "o", color=colour, ms=5, label=name)
    left.set(xlabel="azimuth from the load [deg]", ylabel="roller load [kN]", xlim=(-95, 95))
    left.legend(fontsize=8, frameon=False, title="points: search, lines: formula", title_fontsize=8)
    _barrel_section(right, found)
    figure.suptitle(f"Spherical roller bearing {found.barrel.name}", fontsize=11)
    return figure


def _barrel_section(axes: Axes, found: Findings) -> None:
    bearing = found.barrel
    angle, half = bearing.contact_angle, 0.5 * bearing.roller_length
    spread = np.linspace(-half, half, 41) / bearing.roller_contour
    roller, groove = bearing.roller(np.zeros(3)), bearing.inner_raceway(np.zeros(3))
    upper = np.array([roller.frame(np.array([u, 0.0])).point for u in spread])
    lower = np.array([roller.frame(np.array([u, math.pi])).point for u in spread[::-1]])
    inner = np.array([groove.frame(np.array([math.pi + angle + u, 0.0])).point for u in spread])
    outline = np.concatenate([upper, lower, upper[:1]])
    reach = 1.22 * _MM * bearing.centre_distance
    for side in (-1.0, 1.0):
        axes.fill(side * _MM * outline[:, 2], _MM * outline[:, 0], color=_ROLLER, alpha=0.25, lw=0)
        axes.plot(side * _MM * outline[:, 2], _MM * outline[:, 0], color=_ROLLER, lw=1.5)
        axes.plot(side * _MM * inner[:, 2], _MM * inner[:, 0], color=_CONE, lw=2.5)
        line = [0.0, side * reach * math.sin(angle)], [0.0, reach * math.cos(angle)]
        axes.plot(*line, color="0.6", lw=0.8, ls="--")
        for point in (upper[20], inner[20]):
            axes.plot([side * _MM * point[2]], [_MM * point[0]], "o", color=_POINT, ms=4)
    turn, sphere = np.linspace(-0.36, 0.36, 81), _MM * bearing.outer_sphere
    axes.plot(sphere * np.sin(turn), sphere * np.cos(turn), color=_CUP, lw=2.5)
    axes.set(xlabel="along the bearing axis [mm]", ylabel="radius [mm]", aspect="equal", ylim=(38.0, 88.0))
