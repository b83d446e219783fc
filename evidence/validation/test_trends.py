"""Every published trend on the validation page, with its source."""

from __future__ import annotations

import pytest

from evidence.validation.anchor import Trend
from evidence.validation.every import TRENDS

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("trend", TRENDS, ids=lambda trend: f"{trend.topic}-{trend.claim}")
def test_trend_holds_or_misses_as_the_page_says(trend: Trend) -> None:
    finding = trend.study()
    assert finding.holds is (trend.misses == ""), finding.sentence
