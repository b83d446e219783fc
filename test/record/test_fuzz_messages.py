"""Whatever bytes stand in a message, a scene or a CSV file: a value or a sentence, never a traceback."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from beardyn_core.base.errors import InputError
from beardyn_core.choice import scene_from_text
from beardyn_core.rail.measured import read_measurement
from beardyn_core.record.checking import MessageChecker
from beardyn_core.record.cloud_layout import MalformedError
from beardyn_core.record.clouds import cloud_to_arrays
from beardyn_core.record.encoding import BlockEncoder, temperature_template
from beardyn_core.record.load_stream import encode_load
from beardyn_core.record.messages import (
    Diagnostic,
    decode_diagnostics,
    encode_clock,
    encode_diagnostics,
    encode_string,
)
from beardyn_core.record.reading import run_of_messages
from beardyn_core.record.run_summary import collect_diagnostic
from beardyn_core.record.topics import topic
from test.examples import examples
from test.record.synthetic_run import SyntheticRun, description

RUN = description(0.1)
MESSAGES = {
    **{name: cdr for name, _, cdr in BlockEncoder(17, ("axlebox_top",)).encode(SyntheticRun().block(0))},
    "load/blocks": encode_load(RUN.load.part(0, 40) if RUN.load else RUN.load, 0),  # type: ignore[arg-type]
    "truth": encode_string(RUN.to_json()),
    "/clock": encode_clock(3),
    "temperature": temperature_template("axlebox/cup").encode(np.array([5]), celsius=np.array([[5.0]]))[0],
    "/diagnostics": encode_diagnostics(3, "axlebox", [Diagnostic("a/twin", 0, "b", (("k", "v"),))]),
}
QUICKLY = settings(
    max_examples=examples(150), deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
ARRAYS = ("force", "force_waveform", "sensors", "specific_force", "shaft", "torque", "cages", "rollers")
MORE_ARRAYS = ("bodies", "contacts", "load", "temperature", "diagnostics", "results", "duration")


def mutated(data: st.DataObject, cdr: bytes) -> bytes:
    """A message with some bytes changed, most of them where the structure stands, or cut or lengthened."""
    changed = bytearray(cdr)
    places = st.one_of(st.integers(0, min(len(cdr), 400) - 1), st.integers(0, len(cdr) - 1))
    words = st.sampled_from([0, 1, 2, 255, 2**16, 2**31 - 1, 2**32 - 1, 1000])
    for at in data.draw(st.lists(places, max_size=4)):
        word = data.draw(words).to_bytes(4, "little")
        changed[at : at + 4] = word[: len(changed) - at]
    end = data.draw(st.one_of(st.just(len(changed)), st.integers(0, len(changed))))
    return bytes(changed[:end]) + data.draw(st.binary(max_size=8))


@pytest.mark.parametrize("name", MESSAGES)
@QUICKLY
@given(data=st.data())
def test_what_the_checker_takes_every_reader_can_read(name: str, data: st.DataObject) -> None:
    """Beside a message as it should be, for a reader sees many."""
    bodies, rollers = len(RUN.body_names), RUN.roller_count
    checker, entry = MessageChecker(bodies, rollers), topic(name)
    cdr = mutated(data, MESSAGES[name])
    problem = checker.problem(entry, cdr)
    assert isinstance(problem, str)
    if problem or name == "/clock":
        return
    run = run_of_messages(
        {**{key: [each] for key, each in MESSAGES.items()}, name: [MESSAGES[name], cdr]}, RUN
    )
    for array in (*ARRAYS, *MORE_ARRAYS):
        getattr(run, array)
    assert isinstance(collect_diagnostic(run, "real_time_factor"), list)


@QUICKLY
@given(cdr=st.binary(max_size=300))
def test_any_bytes_are_a_cloud_or_malformed(cdr: bytes) -> None:
    for content in (cdr, b"\x00\x01\x00\x00" + cdr):
        with suppress(MalformedError):
            assert cloud_to_arrays(content) is not None
        for name in MESSAGES:
            assert isinstance(MessageChecker().problem(topic(name), content), str)


@QUICKLY
@given(value=st.text(max_size=20))
def test_a_foreign_diagnostic_stops_no_reader(value: str) -> None:
    status = Diagnostic("somebody", 0, value, (("real_time_factor", value), ("messages force", value)))
    cdr = encode_diagnostics(0, value.replace("\0", ""), [status])
    assert decode_diagnostics(cdr)
    run = run_of_messages({**{key: [each] for key, each in MESSAGES.items()}, "/diagnostics": [cdr]}, RUN)
    assert len(collect_diagnostic(run, "real_time_factor")) <= 1


SCENE = """
bearing: HS130x230
operation: {kind: constant, duration_s: 0.1, speed_kmh: 200, radial_kN: 80}
"""


@QUICKLY
@given(
    text=st.one_of(
        st.text(max_size=120),
        st.tuples(st.integers(0, len(SCENE)), st.text(max_size=6), st.integers(0, 12)).map(
            lambda cut: SCENE[: cut[0]] + cut[1] + SCENE[cut[0] + cut[2] :]
        ),
    )
)
def test_any_scene_text_is_a_scene_or_a_sentence(text: str) -> None:
    with suppress(InputError):
        scene_from_text(text, "fuzz.yaml")


ROWS = "time_s,speed_rpm,fx_N,fy_N,fz_N\n0,900,0,0,80000\n0.001,900,0,0,81000\n0.002,900,0,0,80000\n"


@QUICKLY
@given(
    content=st.one_of(
        st.binary(max_size=120),
        st.tuples(st.integers(0, len(ROWS)), st.text(max_size=6), st.integers(0, 12)).map(
            lambda cut: (ROWS[: cut[0]] + cut[1] + ROWS[cut[0] + cut[2] :]).encode(errors="replace")
        ),
    )
)
def test_any_csv_is_a_measurement_or_a_sentence(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "load.csv"
    path.write_bytes(content)
    with suppress(InputError):
        assert np.isfinite(read_measurement(path).wrench).all()
