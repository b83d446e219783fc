"""The roller end that is too large for its rib."""

from types import SimpleNamespace
from typing import Any

import pytest

from beardyn_core.laboratory.contacts_picture import sphere_figure
from beardyn_core.laboratory.sphere_radius import PUSH, SphereCase, sphere_case, sphere_cases
from test.laboratory.bearings import bearing


@pytest.fixture(scope="module")
def cases() -> dict[float, SphereCase]:
    return {case.ratio: case for case in sphere_cases(bearing())}


def test_search_and_bounded_form_agree_while_the_end_suits_the_rib(cases) -> None:
    for ratio in (0.80, 0.85, 0.90, 0.95):
        case = cases[ratio]
        assert case.search_converged
        assert case.on_face
        assert case.in_rim
        assert case.carried_by == "face"
        assert case.search_gap == pytest.approx(-case.bounded_depth, abs=1e-9)
        assert case.search_height == pytest.approx(case.bounded_height, abs=1e-6)
        assert not case.refused


def test_near_the_apex_the_search_runs_off_and_reports_no_contact(cases) -> None:
    case = cases[1.0]
    assert case.search_gap > 0.0
    assert not case.on_face


def test_beyond_the_apex_its_point_lies_outside_the_roller_end(cases) -> None:
    for ratio in (1.0, 1.05, 1.20):
        assert not cases[ratio].in_rim


def test_the_bounded_form_keeps_the_contact_on_both_parts(cases) -> None:
    data = bearing()
    for case in cases.values():
        assert case.bounded_depth == pytest.approx(PUSH, rel=0.05)
        assert data.rib_undercut <= case.bounded_height <= data.rib_height


def test_the_consistency_check_refuses_what_would_fail(cases) -> None:
    assert all(cases[ratio].refused for ratio in (1.0, 1.05, 1.20))


def test_contact_sinks_as_the_radius_grows() -> None:
    heights = [sphere_case(bearing(), ratio).search_height for ratio in (0.82, 0.88, 0.94)]
    assert heights[0] > heights[1] > heights[2]


def test_no_legend_of_the_picture_hides_a_bar(cases) -> None:
    found: Any = SimpleNamespace(bearing=bearing(), spheres=tuple(cases.values()))
    figure = sphere_figure(found)
    figure.draw_without_rendering()
    _, bars = figure.axes
    legend = bars.get_legend()
    assert legend is not None
    drawn = [each.get_window_extent() for each in bars.patches]
    drawn = [each for each in drawn if each.height > 1.0]
    assert len(drawn) >= len(cases)
    assert not any(legend.get_window_extent().overlaps(each) for each in drawn)
