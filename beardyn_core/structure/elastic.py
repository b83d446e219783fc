"""A meshed box as a linear elastic body: its free modes, its static answers, its rigid motion."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated as A
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_matrix, spmatrix
from scipy.sparse.linalg import LinearOperator, eigsh, splu

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.structure.box import Box, Seat
from beardyn_core.structure.mesh import CUP, EXTRA, Mesh, row_places
from beardyn_core.structure.modes import WAVES

_SHIFT = (2.0 * math.pi * 300.0) ** 2
_SOFT = (2.0 * math.pi * 5.0) ** 2
_PASSES = 8


@dataclass(frozen=True)
class Surface:
    """Skin of a meshed body: flat triangles between the corners of its tetrahedra."""

    places: A[Float, "shape [corner, 3], [m]"]
    triangles: A[NDArray[np.int64], "shape [triangle, 3], corners, anticlockwise as seen from outside"]
    unknowns: A[
        NDArray[np.int64], "shape [corner, 3], where x, y and z of each stand in a motion of the body"
    ]


@dataclass(frozen=True)
class Elastic:
    """Matrices of a free body, and what is read off its motion."""

    stiffness: A[spmatrix, "shape [unknown, unknown], [N/m]"]
    mass: A[spmatrix, "shape [unknown, unknown], [kg]"]
    rigid: A[Float, "shape [unknown, 6]: unit translations, then unit turns about x, y, z of the origin"]
    raceway: A[
        Float,
        "shape [row, field, 2 WAVES + 1, unknown]: mean, then cosines, then sines of the radial, tangential "
        "and axial displacement around the raceway, averaged along the rollers",
    ]
    seats: A[dict[str, Float], "name -> shape [3, unknown], displacement of a sensor or spring"]
    surface: Surface

    @property
    def rigid_mass(self) -> Float:
        """Mass matrix of the rigid body about the bearing centre, shape [6, 6]."""
        return self.rigid.T @ (self.mass @ self.rigid)

    @cached_property
    def _shifted(self) -> Any:
        return factor_matrix(self.stiffness + _SHIFT * self.mass)

    @cached_property
    def _soft(self) -> Any:
        return factor_matrix(self.stiffness + _SOFT * self.mass)

    def modes(self, highest: float, at_least: int = 24) -> tuple[Float, Float]:
        """Compute the free elastic modes up to a frequency [Hz].

        Returns
        -------
        tuple
            Frequencies, [Hz], and shapes with unit modal mass, shape [unknown, mode].
        """
        inverse = LinearOperator(self.stiffness.shape, self._shifted.solve)
        count = at_least
        start = np.cos(np.arange(self.stiffness.shape[0]))  # the same modes every time
        while True:
            squares, shapes = eigsh(
                self.stiffness, k=count, M=self.mass, sigma=-_SHIFT, OPinv=inverse, v0=start
            )
            frequencies = np.sqrt(np.maximum(squares, 0.0)) / (2.0 * np.pi)
            if frequencies.max() > highest:
                break
            count *= 2
        order = np.argsort(frequencies)
        order = order[(frequencies[order] > 1.0) & (frequencies[order] <= highest)]
        return frequencies[order], shapes[:, order]

    def bent(self, loads: Float) -> Float:
        """Compute how a free body bends under constant loads while it accelerates (inertia relief).

        Parameters
        ----------
        loads : array, shape [unknown, case]
            [N].

        Returns
        -------
        array, shape [unknown, case]
            Displacement without rigid motion, [m].
        """
        rigid = self.rigid
        momentum = self.mass @ rigid
        inverse = np.linalg.inv(self.rigid_mass)
        balanced = loads - momentum @ (inverse @ (rigid.T @ loads))
        # springs of a few hertz hold the body; each pass takes away what they carry
        found = np.zeros_like(loads)
        for _ in range(_PASSES):
            more = self._soft.solve(balanced - self.stiffness @ found)
            more -= rigid @ (inverse @ (momentum.T @ more))
            found += more
            if (np.abs(more).max(axis=0) <= 1e-6 * np.abs(found).max(axis=0)).all():
                return found
        raise InputError("the static answer of the box does not converge; take another mesh size")


def elastic_body(box: Box, bearing: RollerBearing, mesh: Mesh) -> Elastic:
    """Assemble the matrices of a meshed box.

    Raises
    ------
    InputError
        scikit-fem is not installed, or a seat lies outside of the box.
    """
    try:
        import skfem
        from skfem.helpers import ddot, div, dot, sym_grad
    except ImportError as error:
        raise InputError(f"finite elements need scikit-fem ({error}); {EXTRA}") from error
    body = _curved_mesh(skfem, mesh)
    basis = skfem.Basis(body, skfem.ElementVector(skfem.ElementTetP2()), intorder=4)
    piecewise = basis.with_element(skfem.ElementTetP0())
    steel = mesh.part == CUP

    def either(cup: float, housing: float) -> Any:
        return piecewise.interpolate(np.where(steel, cup, housing))

    of_cup = bearing.material
    pairs = [
        _lame(modulus, ratio)
        for modulus, ratio in (
            (of_cup.youngs_modulus, of_cup.poisson_ratio),
            (box.youngs_modulus, box.poisson_ratio),
        )
    ]

    @skfem.BilinearForm
    def strain(u: Any, v: Any, w: Any) -> Any:
        return w.first * div(u) * div(v) + 2.0 * w.second * ddot(sym_grad(u), sym_grad(v))

    @skfem.BilinearForm
    def inertia(u: Any, v: Any, w: Any) -> Any:
        return w.density * dot(u, v)

    first, second = (either(pairs[0][i], pairs[1][i]) for i in range(2))
    stiffness = strain.assemble(basis, first=first, second=second).tocsc()
    mass = inertia.assemble(basis, density=either(of_cup.density, box.density)).tocsc()
    places = basis.doflocs.T
    axis = np.zeros(basis.N, np.int64)
    for direction in range(3):
        axis[basis.get_dofs(elements=True).all([f"u^{direction + 1}"])] = direction
    return Elastic(
        stiffness,
        mass,
        _rigid_motion(places, axis),
        _raceway(skfem, body, basis.elem, bearing),
        {seat.name: _at(seat, places, axis) for seat in (*box.sensors, *box.suspension)},
        _surface(body, basis.nodal_dofs.T),
    )


def _surface(body: Any, unknowns: NDArray[np.int64]) -> Surface:
    outside = body.boundary_facets()
    faces = body.facets[:, outside]
    inner = body.t[:, body.f2t[0, outside]].sum(axis=0) - faces.sum(axis=0)
    first, second, third, behind = (body.doflocs[:, each].T for each in (*faces, inner))
    inwards = np.einsum("fi,fi->f", np.cross(second - first, third - first), behind - first) > 0.0
    faces[:, inwards] = faces[::-1, inwards]
    used, triangles = np.unique(faces, return_inverse=True)
    return Surface(body.doflocs[:, used].T, triangles.reshape(3, -1).T, unknowns[used])


def _curved_mesh(skfem: Any, mesh: Mesh) -> Any:
    """Give scikit-fem the tetrahedra with the middles of their edges where gmsh has put them."""
    corners, flat = np.unique(mesh.elements[:, :4], return_inverse=True)
    straight = skfem.MeshTet(mesh.nodes[corners].T.copy(), flat.reshape(-1, 4).T.copy())
    curved = skfem.MeshTet2.from_mesh(straight)
    pairs = ((0, 1), (1, 2), (0, 2), (0, 3), (2, 3), (1, 3))  # gmsh's edges with a node each
    tetra = flat.reshape(-1, 4)
    ends = np.sort(np.concatenate([tetra[:, pair] for pair in pairs]), axis=1)
    middle = np.concatenate([mesh.elements[:, 4 + i] for i in range(6)])
    key = ends[:, 0] * len(corners) + ends[:, 1]
    key, first = np.unique(key, return_index=True)
    wanted = np.sort(straight.edges, axis=0)
    found = np.searchsorted(key, wanted[0] * len(corners) + wanted[1])
    places = curved.doflocs.copy()
    places[:, len(corners) :] = mesh.nodes[middle[first[found]]].T
    chords, right = curved.doflocs, _volume(skfem, curved)
    while True:
        body = skfem.MeshTet2(places, curved.t, sort_t=False)
        turned = np.flatnonzero((_volume(skfem, body) / right < 0.1).any(axis=1))
        if not len(turned):
            return body
        # the middle of an edge that is bent too far for so large an element goes back to the chord
        nodes = np.unique(body.dofs.element_dofs[:, turned])
        places[:, nodes] = chords[:, nodes]


def _volume(skfem: Any, body: Any) -> Float:
    """Compute six times the volume of each point of integration, negative where it is inside out."""
    points, _ = skfem.quadrature.get_quadrature(skfem.ElementTetP2(), 4)
    mapping = body.mapping()
    # scikit-fem's determinant ends in an exception where one is exactly 0, as in a flattened element
    first, second, third = (np.stack([mapping.J(i, j, points) for i in range(3)]) for j in range(3))
    found: Float = np.einsum("iep,iep->ep", np.cross(first, second, axis=0), third)
    return found


def _lame(modulus: float, ratio: float) -> tuple[float, float]:
    return modulus * ratio / ((1.0 + ratio) * (1.0 - 2.0 * ratio)), 0.5 * modulus / (1.0 + ratio)


def _rigid_motion(places: Float, axis: Any) -> Float:
    unit = np.eye(3)
    columns = [unit[direction][axis] for direction in range(3)]
    rows = np.arange(len(axis))
    columns += [np.cross(unit[direction], places)[rows, axis] for direction in range(3)]
    return np.stack(columns, axis=1)


def _raceway(skfem: Any, body: Any, element: Any, bearing: RollerBearing) -> Float:
    """Make the functionals that read the series of the displacement off both roller tracks."""
    radius, half = bearing.cup_radius, 0.5 * bearing.effective_length

    def series(facets: Any) -> Float:
        track = skfem.FacetBasis(body, element, facets=facets, intorder=6)
        found = np.zeros((3, 2 * WAVES + 1, track.N))
        x, _, z = track.global_coordinates()
        angle = np.arctan2(x, z)
        area = float(np.sum(track.dx))
        fields = (
            (np.sin(angle), np.zeros_like(angle), np.cos(angle)),
            (np.cos(angle), np.zeros_like(angle), -np.sin(angle)),
            (np.zeros_like(angle), np.ones_like(angle), np.zeros_like(angle)),
        )
        patterns = [np.full_like(angle, 1.0 / area)]
        patterns += [2.0 / area * np.cos(n * angle) for n in range(1, WAVES + 1)]
        patterns += [2.0 / area * np.sin(n * angle) for n in range(1, WAVES + 1)]
        for i, field in enumerate(fields):
            for k, pattern in enumerate(patterns):
                form = skfem.LinearForm(
                    lambda v, w, field=field, pattern=pattern: (
                        pattern * (field[0] * v[0] + field[1] * v[1] + field[2] * v[2])
                    )
                )
                found[i, k] = form.assemble(track)
        return found

    def track(place: float) -> Any:
        def on_it(x: Float) -> Any:
            return (np.abs(np.hypot(x[0], x[2]) - radius) < 0.05 * radius) & (np.abs(x[1] - place) < half)

        found = body.facets_satisfying(on_it, boundaries_only=True)
        if not len(found):
            raise InputError("the mesh has no raceway; take a smaller mesh size")
        return found

    return np.stack([series(track(place)) for place in row_places(bearing)])


def _at(seat: Seat, places: Float, axis: Any) -> Float:
    distance = np.linalg.norm(places - np.array(seat.position), axis=1)
    if distance.min() > seat.radius:
        raise InputError(
            f"the seat {seat.name!r} is {1e3 * distance.min():.0f} mm away from the box; move it to the box"
        )
    near = distance <= max(seat.radius, distance.min() * (1.0 + 1e-9) + 1e-9)
    found = np.zeros((3, len(axis)))
    for direction in range(3):
        here = near & (axis == direction)
        found[direction, here] = 1.0 / here.sum()
    return found


def factor_matrix(matrix: Any) -> Any:
    """Factor a symmetric sparse matrix without pivoting; the result has a method ``solve``."""
    return splu(
        csc_matrix(matrix),
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )


def stack_functionals(body: Elastic, names: Sequence[str]) -> Float:
    """Join the functionals of raceways and seats, shape [row x field x series, then 3 a seat, unknown]."""
    raceway = body.raceway.reshape(-1, body.raceway.shape[-1])
    return np.concatenate([raceway, *(body.seats[name] for name in names)])
