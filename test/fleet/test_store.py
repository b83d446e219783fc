"""The store: what is committed stays, one writer, versions, and what people enter."""

from __future__ import annotations

import os
import signal
import sqlite3
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import beardyn_core as bd
from beardyn_core.base.errors import InputError
from beardyn_core.fleet.health import OK, PLAN
from beardyn_core.fleet.ranking import EXIT_CODES, rank_fleet
from beardyn_core.fleet.store import open_store
from test.fleet.made_history import BEGIN, BOX, DAY, analysis, recording, wide

WRITER = """
import sys, time
from pathlib import Path
from beardyn_core.fleet.store import open_store
from test.fleet.made_history import analysis, recording
with open_store(Path(sys.argv[1]), write=True, make=True) as store:
    for day in range(100_000):
        store.add(recording(day), analysis())
        print(day, flush=True)
"""


def filled(path: Path, verdicts: list[str], **more: object) -> None:
    with open_store(path, write=True, make=True) as store:
        for day, verdict in enumerate(verdicts):
            store.add(recording(day), analysis(verdict))
            store.add(recording(day, BOX._replace(axle="2")), analysis())


def test_what_is_stored_comes_back(tmp_path: Path) -> None:
    path = tmp_path / "s.sqlite"
    made = wide("cup", 8e-3)
    with open_store(path, write=True, make=True) as store:
        store.add(recording(3), made)
    with open_store(path) as store:
        (found,) = store.recordings()
    np.testing.assert_allclose(found.analysis.levels, made.levels, atol=1e-5)
    assert found.analysis.width == made.width
    assert np.isnan(found.analysis.temperature)
    assert (found.axlebox, found.time, found.analysis.verdict) == (BOX, BEGIN + 3 * DAY, "cup")


def test_a_list_has_no_estimates_and_the_store_keeps_them(tmp_path: Path) -> None:
    path = tmp_path / "s.sqlite"
    with open_store(path, write=True, make=True) as store:
        store.add(recording(0), analysis(estimate={"strangeness": 0.4}, assumed=("speed is stated",)))
    with open_store(path) as store:
        (found,) = store.recordings()
    assert found.analysis.estimate == {}
    assert found.analysis.assumed == ("speed is stated",)
    kept = sqlite3.connect(path).execute(
        "select json_extract(detail, '$.estimate.strangeness') from recording"
    )
    assert kept.fetchone() == (0.4,)


def test_a_killed_writer_loses_nothing_and_leaves_no_lock(tmp_path: Path) -> None:
    path = tmp_path / "s.sqlite"
    process = subprocess.Popen(
        [sys.executable, "-c", WRITER, str(path)],
        stdout=subprocess.PIPE, text=True, env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
    )  # fmt: skip
    assert process.stdout is not None
    told = -1
    while told < 20:
        line = process.stdout.readline()
        assert line, "the writer ended"
        told = int(line)
    with pytest.raises(InputError, match="another process is writing"), open_store(path, write=True):
        pass
    with open_store(path) as store:  # reading goes on beside it
        assert store.count() > 20
    process.send_signal(signal.SIGKILL)
    rest = process.stdout.read().split()
    process.wait()
    last = max([told, *(int(each) for each in rest if each.isdigit())])
    with open_store(path, write=True) as store:
        days = sorted(round((each.time - BEGIN) / DAY) for each in store.recordings())
    assert days == list(range(len(days)))
    assert len(days) >= last  # a line that was cut off may have been of the last one


def test_another_version_and_another_file_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "s.sqlite"
    filled(path, ["healthy"])
    connection = sqlite3.connect(path)
    connection.execute("pragma user_version = 99")
    connection.close()
    with pytest.raises(InputError, match="is of version 99"), open_store(path):
        pass
    other = tmp_path / "other.sqlite"
    other.write_text("no database at all, but long enough to look like something " * 20)
    with pytest.raises(InputError, match="no store of a fleet"), open_store(other):
        pass
    with pytest.raises(InputError, match="does not exist"), open_store(tmp_path / "gone.sqlite"):
        pass


def test_an_alarm_leads_the_list_until_it_is_acknowledged_and_again_when_it_is_raised_anew(
    tmp_path: Path,
) -> None:
    path = tmp_path / "s.sqlite"
    filled(path, ["cup"] * 4)
    boxes = bd.fleet(path)
    first = boxes.status().standings[0]
    assert (first.axlebox, first.health.state, first.acknowledged) == (BOX, PLAN, None)
    assert boxes.status().exit_code == EXIT_CODES[PLAN]
    told = boxes.acknowledge("V1", "1", "L", by="a fitter", note="ordered")
    assert "plan acknowledged by a fitter" in told
    entry = boxes.status().standings[0].acknowledged
    assert entry is not None
    assert entry.note == "ordered"
    with open_store(path, write=True) as store:
        for day in range(4, 30):
            store.add(recording(day), analysis("healthy" if day < 26 else "cup"))
    again = boxes.status().standings[0]
    assert again.health.state == PLAN
    assert again.acknowledged is None
    with pytest.raises(InputError, match="nothing to acknowledge"):
        boxes.acknowledge("V1", "2", "left", by="a fitter")
    with pytest.raises(InputError, match="is not in the store; nearest are"):
        boxes.acknowledge("V1", "9", "left", by="a fitter")


def test_acknowledged_alarms_come_after_those_that_nobody_has(tmp_path: Path) -> None:
    path = tmp_path / "s.sqlite"
    with open_store(path, write=True, make=True) as store:
        for day in range(5):
            for axle, width in (("1", 9e-3), ("2", 6e-3), ("3", 0.0)):
                made = wide("cup", width) if width else analysis()
                store.add(recording(day, BOX._replace(axle=axle)), made)
    boxes = bd.fleet(path)
    assert [each.axlebox.axle for each in boxes.status().standings] == ["1", "2", "3"]
    boxes.acknowledge("V1", "1", "left", by="a fitter")
    assert [each.axlebox.axle for each in boxes.status().standings] == ["2", "1", "3"]


def test_an_exchange_is_entered_and_starts_anew(tmp_path: Path) -> None:
    path = tmp_path / "s.sqlite"
    filled(path, ["cup"] * 5 + ["healthy"] * 2)
    boxes = bd.fleet(path)
    assert boxes.status().standings[0].health.state == PLAN
    when = time.strftime("%Y-%m-%dT%H:%M:%S", time.gmtime(BEGIN + 4.5 * DAY))
    boxes.exchanged("V1", "1", "left", time=when, mileage_km=102_000)
    assert {each.health.state for each in boxes.status().standings} == {OK}
    with pytest.raises(InputError, match="in the future"):
        boxes.exchanged("V1", "1", "left", time="2999-01-01")


def test_an_axlebox_without_recordings_for_long_cannot_tell(tmp_path: Path) -> None:
    path = tmp_path / "s.sqlite"
    filled(path, ["healthy"] * 6)
    with open_store(path, write=True) as store:
        for day in range(6, 20):
            store.add(recording(day, BOX._replace(axle="2")), analysis())
    with open_store(path) as store:
        first = rank_fleet(store).standings[0]
        assert first.axlebox == BOX
        assert first.health.state == "cannot_tell"
        assert "no recording for 14 days, where one every 1.0 days was usual" in first.health.why[0]
        earlier = rank_fleet(store, as_of=BEGIN + 5.5 * DAY)
    assert {each.health.state for each in earlier.standings} == {OK}
