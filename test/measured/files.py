"""Small measured files of every format, made of one signal."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import beardyn_core as bd
from beardyn_core.base.arrays import Float
from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.config import load_plate

RATE = 12_000.0
COUNT = 6000
G = 9.80665


def noise(count: int = COUNT, axes: int = 1, seed: int = 1) -> Float:
    """Noise with three digits, as a file of a logger has it, shape [sample, axis], [g]."""
    return np.asarray(np.round(np.random.default_rng(seed).normal(0.0, 1.0, (count, axes)), 3))


def struck(
    strikes_per_turn: float,
    seconds: float = 4.0,
    rate: float = RATE,
    shaft_hz: float = 30.0,
    turned: Any = None,
) -> Float:
    """Strikes that ring at 3 kHz in noise, shape [sample, 1], [m/s^2]."""
    time = np.arange(round(seconds * rate)) / rate
    turns = shaft_hz * time if turned is None else turned
    strike = np.concatenate(([0.0], np.diff(np.floor(turns * strikes_per_turn))))
    ring_time = np.arange(round(0.004 * rate)) / rate
    ring = np.exp(-ring_time / 6e-4) * np.sin(2.0 * np.pi * 3000.0 * ring_time)
    signal = 40.0 * np.convolve(strike, ring)[: len(time)]
    return np.asarray((signal + np.random.default_rng(3).normal(0.0, 0.5, len(time)))[:, None])


def frequencies(name: str) -> FaultFrequencies:
    return load_plate(name).frequencies


def table(
    path: Path, columns: dict[str, Float], separator: str = ",", decimal: str = ".", header: bool = True
) -> Path:
    rows = [separator.join(columns)] if header else []
    rows += [
        separator.join(f"{value:.9g}" for value in values).replace(".", decimal)
        for values in zip(*columns.values(), strict=True)
    ]
    path.write_text("\n".join(rows) + "\n", encoding="utf-8")
    return path


def _csv(path: Path, values: Float) -> Path:
    return table(path, {"time_s": np.arange(len(values)) / RATE, **_named(values)})


def _named(values: Float) -> dict[str, Float]:
    return {
        f"acc_{axis} [g]": column for axis, column in zip("xyz"[-values.shape[1] :], values.T, strict=True)
    }


def _matlab(path: Path, values: Float) -> Path:
    from scipy.io import savemat

    arrays = {
        f"a{axis}": column[:, None] for axis, column in zip("xyz"[-values.shape[1] :], values.T, strict=True)
    }
    savemat(path, {"data": {**arrays, "sr": RATE}})
    return path


def _matlab_73(path: Path, values: Float) -> Path:
    """As MATLAB writes it: a block of 512 bytes with a sentence, then HDF5, arrays lying on their side."""
    import h5py

    with h5py.File(path, "w", userblock_size=512) as file:
        for axis, column in zip("xyz"[-values.shape[1] :], values.T, strict=True):
            stored = file.create_dataset(f"a{axis}", data=column[None, :])
            stored.attrs["MATLAB_class"] = np.bytes_("double")
        file.create_dataset("fs", data=[[RATE]])
    with path.open("r+b") as raw:
        raw.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64")
    return path


def _hdf5(path: Path, values: Float) -> Path:
    import h5py

    with h5py.File(path, "w") as file:
        group = file.create_group("vibration")
        group.create_dataset("values", data=values, compression="gzip").attrs["unit"] = "g"
        group.attrs["rate_Hz"] = RATE
    return path


def _wav(path: Path, values: Float) -> Path:
    import soundfile

    soundfile.write(path, values, round(RATE), subtype="DOUBLE")
    return path


def _npz(path: Path, values: Float) -> Path:
    np.savez_compressed(path, acceleration=values, fs=RATE)
    return path


def _npy(path: Path, values: Float) -> Path:
    np.save(path, values)
    return path


def _tdms(path: Path, values: Float) -> Path:
    from nptdms import ChannelObject, TdmsWriter

    with TdmsWriter(str(path)) as writer:
        for axis, column in zip("xyz"[-values.shape[1] :], values.T, strict=True):
            said = {"wf_increment": 1.0 / RATE, "unit_string": "g"}
            writer.write_segment(
                [ChannelObject("axlebox", f"a{axis}", np.ascontiguousarray(column), properties=said)]
            )
    return path


def _universal(path: Path, values: Float) -> Path:
    import pyuff

    file = pyuff.UFF(str(path))
    sets = [
        pyuff.prepare_58(
            binary=0, func_type=1, rsp_node=1, rsp_dir=4 - values.shape[1] + k, ref_dir=0, ref_node=0,
            data=column, x=np.arange(len(column)) / RATE, id1="NONE", rsp_ent_name="NONE",
            ref_ent_name="NONE",
            abscissa_spacing=1, abscissa_spec_data_type=17, ordinate_spec_data_type=12,
            orddenom_spec_data_type=0, z_axis_spec_data_type=0, ordinate_axis_units_lab="g",
            ord_data_type=4, abscissa_inc=1.0 / RATE,
        )
        for k, column in enumerate(values.T)
    ]  # fmt: skip
    file.write_sets(sets, mode="overwrite")
    return path


def _mdf(path: Path, values: Float) -> Path:
    from asammdf import MDF, Signal

    time = np.arange(len(values)) / RATE
    with MDF(version="4.10") as file:
        names = (f"a{axis}" for axis in "xyz"[-values.shape[1] :])
        file.append(
            [
                Signal(np.array(column), time, name=n, unit="g")
                for n, column in zip(names, values.T, strict=True)
            ]
        )
        file.save(path, overwrite=True)
    return path


def _parquet(path: Path, values: Float) -> Path:
    import pyarrow
    from pyarrow import parquet

    start = np.datetime64("2026-01-02T03:04:05", "ns")
    time = start + np.round(np.arange(len(values)) * 1e9 / RATE).astype("timedelta64[ns]")
    parquet.write_table(pyarrow.table({"timestamp": time, **_named(values)}), path)
    return path


def mcap(path: Path, values: Float, encoding: str = "cdr") -> Path:
    """An IMU of another program, a message a sample."""
    from mcap.writer import Writer
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS2_HUMBLE)
    three = np.zeros((len(values), 3))
    three[:, 3 - values.shape[1] :] = values * G
    with path.open("wb") as file:
        writer = Writer(file)
        writer.start(profile="ros2", library="other")
        definition = store.generate_msgdef("sensor_msgs/msg/Imu", ros_version=2)[0].encode()
        schema = writer.register_schema("sensor_msgs/msg/Imu", "ros2msg", definition)
        if encoding == "json":
            schema = writer.register_schema("imu", "jsonschema", b"{}")
        channel = writer.register_channel("/imu/data", encoding, schema)
        types = store.types
        for k, (x, y, z) in enumerate(three.tolist()):
            stamp = round(k * 1e9 / RATE)
            seconds, nanoseconds = divmod(stamp, 10**9)
            if encoding == "json":
                message: Any = {"linear_acceleration": {"x": x, "y": y, "z": z}}
                data = json.dumps(message).encode()
            else:
                vector = types["geometry_msgs/msg/Vector3"]
                header = types["std_msgs/msg/Header"](
                    types["builtin_interfaces/msg/Time"](seconds, nanoseconds), "imu"
                )
                message = types["sensor_msgs/msg/Imu"](
                    header, types["geometry_msgs/msg/Quaternion"](0.0, 0.0, 0.0, 1.0), np.zeros(9),
                    vector(0.0, 0.0, 0.0), np.zeros(9), vector(x, y, z), np.zeros(9),
                )  # fmt: skip
                data = bytes(store.serialize_cdr(message, "sensor_msgs/msg/Imu"))
            writer.add_message(channel, stamp, data, stamp)
        writer.finish()
    return path


@dataclass(frozen=True)
class Kind:
    """A format: how a file of it is made, and what it does not say by itself."""

    name: str
    ending: str
    write: Callable[[Path, Float], Path]
    needs: dict[str, Any]
    one: dict[str, Any]  # besides, of a file with one axis
    single: bool = False  # numbers are float32

    def make(self, folder: Path, values: Float) -> Path:
        return self.write(folder / f"measured{self.ending}", values)


KINDS = (
    Kind("csv", ".csv", _csv, {}, {}),
    Kind("matlab", ".mat", _matlab, {"unit": "g"}, {}),
    Kind("matlab 7.3", ".mat", _matlab_73, {"unit": "g"}, {}),
    Kind("hdf5", ".h5", _hdf5, {}, {}),
    Kind("wav", ".wav", _wav, {"unit": "g", "channels": "x=1,y=channel_2,z=channel_3"}, {"channels": "1"}),
    Kind("npz", ".npz", _npz, {"unit": "g"}, {}),
    Kind("npy", ".npy", _npy, {"unit": "g", "rate_Hz": RATE}, {}),
    Kind("tdms", ".tdms", _tdms, {}, {}),
    Kind("universal", ".uff", _universal, {}, {}, single=True),
    Kind("mdf", ".mf4", _mdf, {}, {}),
    Kind("parquet", ".parquet", _parquet, {}, {}),
    Kind("mcap", ".mcap", mcap, {}, {"channels": "z=*acceleration.z"}),
)  # fmt: skip


def problems(files: Any, **options: Any) -> list[str]:
    with pytest.raises(bd.InputError) as caught:
        bd.read_measured(files, **options)
    return caught.value.problems
