"""Reading a recording whatever it consists of: one MCAP file, or a folder of them with an index."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import yaml

from beardyn_core.base.errors import InputError
from beardyn_core.base.inputs import text_of_file
from beardyn_core.record.mcap_scanning import END_RECORD, McapScan, RecordedMessage

INDEX = "metadata.yaml"
CONTINUED = "the recording goes on in "
_INFORMATION = "rosbag2_bagfile_information"
_LONGEST_INDEX = 64 * 1024 * 1024


def part_name(folder: Path, number: int) -> str:
    """Name a file of a recording in several, as rosbag2 does."""
    return f"{folder.name}_{number}.mcap"


def is_folder_of_files(path: Path | str) -> bool:
    """Tell whether a path means a folder of files, by itself or by its index."""
    return Path(path).is_dir() or Path(path).name == INDEX


def files_of(path: Path | str) -> list[Path]:
    """List the files of a recording in their order.

    Parameters
    ----------
    path : Path
        One file; or a folder with ``metadata.yaml``, as the recorder and rosbag2 make it; or that index. A
        file that was begun after the index was written belongs to it too.

    Raises
    ------
    InputError
        The index cannot be read or does not list files of the folder.
    """
    path = Path(path)
    if not is_folder_of_files(path):
        return [path]
    folder = path if path.is_dir() else path.parent
    index = folder / INDEX
    listed = [folder / name for name in _list_files(index)] if index.is_file() else []
    found = [each for each in folder.glob("*.mcap") if re.search(r"_\d+\.mcap$", each.name)]
    further = [
        each for each in found if each not in listed and _number(each) > max(map(_number, listed), default=-1)
    ]
    files = listed + sorted(further, key=_number)
    if not files:
        raise InputError(
            f"{path}: cannot read the recording (the folder has neither {INDEX} nor files NAME_0.mcap); give "
            "the path of an .mcap file, or of the folder of a recording in several"
        )
    return files


def _number(path: Path) -> int:
    found = re.search(r"_(\d+)\.mcap$", path.name)
    return int(found.group(1)) if found else -1


def _list_files(index: Path) -> list[str]:
    wanted = f"{_INFORMATION}: relative_file_paths as rosbag2 writes it is needed"
    try:
        if index.stat().st_size > _LONGEST_INDEX:
            raise InputError(f"{index}: is too large for an index of files; {wanted}")
        content = yaml.safe_load(text_of_file(index))
    except OSError as error:
        raise InputError(f"{index}: cannot be read ({error.strerror})") from error
    except (yaml.YAMLError, ValueError, RecursionError) as error:
        raise InputError(f"{index}: is not an index of files ({type(error).__name__}); {wanted}") from error
    information = content.get(_INFORMATION) if isinstance(content, dict) else None
    names = information.get("relative_file_paths") if isinstance(information, dict) else None
    if not isinstance(names, list) or not all(isinstance(name, str) and name for name in names):
        raise InputError(f"{index}: does not list files; {wanted}")
    for name in names:
        if Path(name).name != name or "\0" in name:
            raise InputError(f"{index}: lists '{name}', which is not the name of a file next to it")
        if Path(name).suffix != ".mcap":
            raise InputError(f"{index}: lists '{name}'; only files that end in .mcap can be read")
    return list(dict.fromkeys(names))


class BagScan:
    """A pass over the files of a recording, one behind the other; the same to use as a `McapScan`.

    A file that is not there or not usable is skipped, and `problem` says so.

    Parameters
    ----------
    path : Path
        Folder or index.
    """

    def __init__(self, path: Path | str) -> None:
        self.path = Path(path)
        self.files = files_of(path)
        self.attachments: dict[str, bytes] = {}
        self.metadata: dict[str, dict[str, str]] = {}
        self.size_bytes = self.usable_bytes = 0
        self.complete = False
        self.problem = ""

    def messages(self) -> Iterator[RecordedMessage]:
        """Read the messages of all files in the order of the files."""
        problems = []
        self.size_bytes = self.usable_bytes = 0
        for file in self.files:
            try:
                scan = McapScan(file)
            except InputError as error:
                problems += error.problems
                self.metadata.pop(END_RECORD, None)
                continue
            yield from scan.messages()
            self.size_bytes += scan.size_bytes
            self.usable_bytes += scan.usable_bytes
            self.attachments.update(scan.attachments)
            self.metadata.update(scan.metadata)
            if not scan.complete:
                problems.append(scan.problem)
            if END_RECORD not in scan.metadata:
                self.metadata.pop(END_RECORD, None)
        self.complete = not problems
        self.problem = "; ".join(problems)


def scan_recording(path: Path | str) -> McapScan | BagScan:
    """Begin a pass over a recording in one file or in several.

    Parameters
    ----------
    path : Path
        MCAP file, folder with ``metadata.yaml``, or that index.

    Raises
    ------
    InputError
        It is absent or no recording at all.
    """
    return BagScan(path) if is_folder_of_files(path) else McapScan(path)


def cut_files(path: Path | str) -> list[Path]:
    """List the files of a recording that are there and were not closed properly."""
    found = []
    for file in files_of(path):
        if file.is_file() and file.stat().st_size:
            scan = McapScan(file)
            for _ in scan.messages():
                pass
            if not scan.complete:
                found.append(file)
    return found
