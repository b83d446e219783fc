"""What rosbag2 wants to know of a recording: in each file, and as ``metadata.yaml`` of a folder of files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import Annotated as A
from typing import Any

import yaml

from beardyn_core.record.messages import typestore
from beardyn_core.record.topics import Topic, topic

_FOREVER = {"sec": 9223372036, "nsec": 854775807}
# the same text in an eighth of the time, where PyYAML was built with libyaml: a train has a thousand topics
_DUMPER = getattr(yaml, "CSafeDumper", yaml.SafeDumper)


@dataclass(frozen=True)
class FileFacts:
    """One file of a recording."""

    name: A[str, "without folder"]
    begin_ns: A[int, "first log time, [ns]"]
    end_ns: A[int, "last log time, [ns]"]
    counts: A[Mapping[str, int], "messages by name in the topic table"]

    @property
    def message_count(self) -> int:
        """Messages of all topics."""
        return sum(self.counts.values())

    def to_mapping(self) -> dict[str, Any]:
        """Give the entry of the file."""
        return {
            "path": self.name,
            "starting_time": {"nanoseconds_since_epoch": self.begin_ns},
            "duration": {"nanoseconds": self.end_ns - self.begin_ns},
            "message_count": self.message_count,
        }


def bag_metadata(files: Sequence[FileFacts], namespace: str) -> dict[str, Any]:
    """Gather the metadata of a recording, version 9 of rosbag2.

    Parameters
    ----------
    files : sequence of FileFacts
        At least one.
    namespace : str
        Of the topics.
    """
    counts: dict[str, int] = {}
    for file in files:
        for name, count in file.counts.items():
            counts[name] = counts.get(name, 0) + count
    filled = [file for file in files if file.message_count] or list(files)
    begin, end = min(file.begin_ns for file in filled), max(file.end_ns for file in filled)
    return {
        "version": 9,
        "storage_identifier": "mcap",
        "duration": {"nanoseconds": end - begin},
        "starting_time": {"nanoseconds_since_epoch": begin},
        "message_count": sum(counts.values()),
        "topics_with_message_count": [
            {"topic_metadata": _topic_metadata(topic(name), namespace), "message_count": count}
            for name, count in counts.items()
        ],
        "compression_format": "",
        "compression_mode": "",
        "relative_file_paths": [file.name for file in files],
        "files": [file.to_mapping() for file in files],
        "custom_data": None,
        "ros_distro": "",
    }


def _topic_metadata(entry: Topic, namespace: str) -> dict[str, Any]:
    return {
        "name": entry.path(namespace),
        "type": entry.type,
        "serialization_format": "cdr",
        "offered_qos_profiles": [qos_profile(entry)],
        "type_description_hash": type_hash(entry.type),
    }


def qos_profile(entry: Topic) -> dict[str, object]:
    """Give the QoS that a topic is offered with, as rosbag2 writes it."""
    return {
        "history": "keep_last" if entry.depth else "keep_all",
        "depth": entry.depth,
        "reliability": entry.reliability,
        "durability": entry.durability,
        "deadline": dict(_FOREVER),
        "lifespan": dict(_FOREVER),
        "liveliness": "automatic",
        "liveliness_lease_duration": dict(_FOREVER),
        "avoid_ros_namespace_conventions": False,
    }


def qos_text(entry: Topic) -> str:
    """Write the same as YAML."""
    return _qos_text(replace(entry, name=""))


@cache
def _qos_text(entry: Topic) -> str:
    """Write the QoS of a topic of any name: those of the boxes of a train differ in nothing else."""
    return yaml_text([qos_profile(entry)])


def yaml_text(content: Any) -> str:
    """Write mappings and lists as YAML in the order of their keys."""
    return str(yaml.dump(content, Dumper=_DUMPER, sort_keys=False))


@cache
def type_hash(kind: str) -> str:
    """Work out the hash of a message type, as REP-2016 has it."""
    return typestore().hash_rihs01(kind)
