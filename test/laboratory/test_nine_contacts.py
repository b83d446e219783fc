"""The nine contacts: closed forms and general search within a nanometre, and gaps that make sense."""

import numpy as np
import pytest

from beardyn_core.config import load_bearing
from beardyn_core.laboratory.closed_forms import ClosedForms, contact_gap
from beardyn_core.laboratory.compiled import batch
from beardyn_core.laboratory.findings import locate
from beardyn_core.laboratory.nine_contacts import (
    NAMES,
    SEARCHES_PER_ROLLER,
    RollerPose,
    contacts_of,
    nominal_pose,
)
from beardyn_core.laboratory.placements import loaded_row, random_rollers
from beardyn_core.laboratory.search import (
    SURFACES,
    SURFACES_CROSSED,
    SURFACES_PRINTED,
    condition_number,
    search,
)
from beardyn_core.laboratory.timing import form_results
from test.laboratory.bearings import bearing

NANOMETRE = 1e-9
FR = 12  # after six discs on each raceway


def gaps(pose: RollerPose) -> dict[str, float]:
    """Gap of each name; of the discs the middle one."""
    found: dict[str, float] = {}
    for contact in contacts_of(bearing(), pose):
        found.setdefault(contact.name, search(contact.pair, contact.start).gap)
    return found


def test_a_roller_has_nineteen_searches_of_nine_contacts() -> None:
    contacts = contacts_of(bearing(), nominal_pose(bearing()))
    assert len(contacts) == SEARCHES_PER_ROLLER == 19
    assert tuple(dict.fromkeys(contact.name for contact in contacts)) == NAMES


def test_the_nominal_roller_touches_raceways_and_rib_and_has_its_clearances() -> None:
    found, data = gaps(nominal_pose(bearing())), bearing()
    for name in ("Inner", "Outer", "FR"):
        assert found[name] == pytest.approx(0.0, abs=1e-3 * NANOMETRE)
    for name in ("C3.1", "C3.2"):
        assert found[name] == pytest.approx(0.5 * data.cage.circumferential_clearance, abs=1e-3 * NANOMETRE)
    for name in ("C2.1", "C4.1", "C4.2"):
        assert found[name] == pytest.approx(0.5 * data.cage.axial_clearance, abs=1e-3 * NANOMETRE)
    # the face leans 1 deg from the end: cos(1 deg) of the clearance
    assert found["FL"] == pytest.approx(data.small_rib_clearance * np.cos(np.radians(1.0)), rel=1e-4)


def test_a_shift_changes_each_gap_by_its_normal() -> None:
    data, shift = bearing(), np.array([3e-6, 0.0, 2e-6])
    nominal = nominal_pose(data)
    before = gaps(nominal)
    after = gaps(RollerPose(nominal.centre + shift, nominal.axis, nominal.cone))
    radial, axial = shift[0], shift[2]
    outer = -np.cos(data.cup_angle) * radial + np.sin(data.cup_angle) * axial
    inner = np.cos(data.cone_angle) * radial - np.sin(data.cone_angle) * axial
    lean = data.contact_angle - data.rib_polar_angle
    rib = -np.sin(lean) * radial - np.cos(lean) * axial
    for name, change in (("Outer", outer), ("Inner", inner), ("FR", rib)):
        assert after[name] - before[name] == pytest.approx(change, abs=1e-3 * NANOMETRE)


def test_general_search_and_both_closed_forms_agree_over_the_row_at_the_first_time_step() -> None:
    for pose in loaded_row(bearing(), 5000.0, 0.0):
        for contact in locate(bearing(), pose):
            assert abs(contact.plain_difference) < NANOMETRE
            assert abs(contact.compiled_difference) < NANOMETRE


@pytest.mark.parametrize("name", ["METRO120x220", "FR130x230x150", "AARK_6.5x9"])
def test_they_agree_in_other_bearings(name: str) -> None:
    other = load_bearing(name)
    for pose in loaded_row(other, 20.0e3, 0.0)[:3]:
        for contact in locate(other, pose):
            assert max(abs(contact.plain_difference), abs(contact.compiled_difference)) < NANOMETRE


def test_they_agree_on_rollers_at_random() -> None:
    poses = list(random_rollers(bearing(), 40, seed=3))
    compiled = ClosedForms(bearing()).gaps(poses)
    contacts = [contact for pose in poses for contact in contacts_of(bearing(), pose)]
    _, iterations, found = batch([c.pair for c in contacts], [c.start for c in contacts]).solve()
    assert (iterations >= 0).all()
    off = np.abs(found.reshape(compiled.shape) - compiled) > NANOMETRE
    # skewed by 2 mrad the rib contact is far from its start: Newton may leave for another stationary point
    assert off[:, FR].mean() < 0.05
    off[:, FR] = False
    assert not off.any()


def test_the_rib_contact_of_a_skewed_roller_is_found_step_by_step() -> None:
    nominal, closed = nominal_pose(bearing()), ClosedForms(bearing())
    for pose in random_rollers(bearing(), 40, seed=3):
        parameters = contacts_of(bearing(), nominal)[FR].start
        for share in np.linspace(0.1, 1.0, 10):
            axis = nominal.axis + share * (pose.axis - nominal.axis)
            between = RollerPose(
                nominal.centre + share * (pose.centre - nominal.centre),
                axis / np.linalg.norm(axis),
                share * pose.cone,
            )
            found = search(contacts_of(bearing(), between)[FR].pair, parameters)
            parameters = found.parameters
        assert found.converged
        assert found.gap == pytest.approx(closed.gaps([between])[0, FR], abs=NANOMETRE)


def test_plain_and_compiled_closed_forms_are_the_same() -> None:
    poses = list(random_rollers(bearing(), 10, seed=6))
    plain = [[contact_gap(bearing(), pose, c) for c in contacts_of(bearing(), pose)] for pose in poses]
    np.testing.assert_allclose(plain, ClosedForms(bearing()).gaps(poses), atol=0.1 * NANOMETRE)


def test_the_loaded_row_presses_the_rollers_under_the_load_only() -> None:
    row = loaded_row(bearing(), 5000.0, 0.0)
    pressed = [gaps(pose)["Inner"] < -1e-9 for pose in row]
    count = bearing().roller_count
    assert pressed[0]
    assert not pressed[count // 2]
    assert pressed[1:] == pressed[:0:-1]


def test_end_play_opens_the_loaded_row_where_no_load_is() -> None:
    row = loaded_row(bearing(), 5000.0, 100e-6)
    compiled = ClosedForms(bearing()).gaps(row)
    # inner and outer gap of the opposite roller: what the play leaves free
    assert compiled[bearing().roller_count // 2, 0] + compiled[bearing().roller_count // 2, 6] > 1e-6
    assert compiled[0, 0] < 0.0


def test_eq_3_with_the_same_tangents_is_singular_in_the_meridian_plane() -> None:
    def condition(form) -> float:
        contact = next(c for c in contacts_of(bearing(), nominal_pose(bearing()), form) if c.name == "FR")
        return condition_number(contact.pair, contact.start)

    assert condition(SURFACES_PRINTED) > 1e12
    assert condition(SURFACES_CROSSED) < 1e4
    assert condition(SURFACES) < 1e4


def test_eq_3_as_printed_fails_on_rollers_that_the_others_find() -> None:
    poses = list(random_rollers(bearing(), 60, seed=5))
    printed, crossed, parallel = form_results(
        bearing(), poses, (SURFACES_PRINTED, SURFACES_CROSSED, SURFACES)
    )
    assert printed.failures > 0.5
    assert crossed.failures < 0.2
    assert parallel.failures < 0.05
