"""The page of widths counts what was measured, what was not, and healthy bearings that were given a width."""

from math import nan

from beardyn_core.monitor.severity import NOT_MEASURABLE, Severity
from evidence.measured import spall_width


def _found(width_mm):
    return Severity("developed", 1e-3 * width_mm, 1e-3 * (width_mm - 0.5), 1e-3 * (width_mm + 0.5), "")


def test_page_counts_hits_misses_and_false_widths():
    none = Severity(NOT_MEASURABLE, nan, nan, nan, "")
    text = spall_width.page(
        {("cup", 0.0): [_found(3.0), none], ("cup", 6.0): [_found(6.2), _found(7.0)]}, "full"
    )
    assert "Of 2 measured widths 1 lie within their interval" in text
    assert "0.60 mm in the median and 1.00 mm at most" in text
    assert "of healthy bearings 1 were given a width" in text
    assert "| cup | 6 | 6.2 (5.7 to 6.7) | 7.0 (6.5 to 7.5) |" in text


def test_the_page_in_the_documentation_is_of_these_widths():
    text = spall_width.PAGE.read_text(encoding="utf-8")
    for width in spall_width.WIDTHS_MM:
        assert f"| cup | {width:g} |" in text
