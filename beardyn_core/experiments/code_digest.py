"""Digests of code: the code of a monitor, and all that a simulated run depends on."""

from __future__ import annotations

import ast
import hashlib
import importlib
import importlib.util
import site
import sys
import sysconfig
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from types import ModuleType

_CORE = Path(__file__).resolve().parents[1]
NUMBERS = ("numpy", "numba", "llvmlite", "scipy")
_LENGTH = 16


def monitor_digest(name: str) -> str:
    """Hash the code of a monitor: its module and every module that it imports, directly or not.

    Of Python's own modules and of installed packages only the version counts. Data that a monitor reads
    from files is not seen. The name is ``module:function``, '' for the reference chain, which is part of
    `simulator_digest`.
    """
    digest = hashlib.sha256(name.encode())
    if name:
        files, packages = modules_of(name.partition(":")[0])
        for module, path in sorted(files.items()):
            digest.update(f"\n{module}\n".encode())
            digest.update(path.read_bytes())
        digest.update("\n".join(_package_version(package) for package in sorted(packages)).encode())
    return digest.hexdigest()[:_LENGTH]


@cache
def simulator_digest() -> str:
    """Hash the sources of this package and the versions of what its numbers depend on."""
    return files_digest(_CORE.rglob("*.py"), _CORE, ("beardyn", *NUMBERS))


def files_digest(paths: Iterable[Path], root: Path, packages: Sequence[str] = NUMBERS) -> str:
    """Hash files with their places below a folder, Python's version and those of packages."""
    digest = hashlib.sha256(sys.version.encode())
    for package in packages:
        digest.update(_package_version(package).encode())
    for path in sorted(paths):
        digest.update(f"\n{path.relative_to(root)}\n".encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()[:_LENGTH]


def modules_of(name: str) -> tuple[dict[str, Path], set[str]]:
    """Find a module and all that it imports, also inside of its functions.

    Returned are files by the name of their module, without installed packages, Python's own and this package,
    and the names of the installed packages.
    """
    files: dict[str, Path] = {}
    packages: set[str] = set()
    importlib.import_module(name)
    waiting, seen = [name], set[str]()
    while waiting:
        module = waiting.pop()
        if module in seen:
            continue
        seen.add(module)
        if module.rpartition(".")[0]:
            waiting.append(module.rpartition(".")[0])
        top = module.partition(".")[0]
        if top in sys.stdlib_module_names or top == "beardyn_core":
            continue
        path = _file_of(module)
        if path is None:
            continue
        if any(path.is_relative_to(folder) for folder in _installed_folders()):
            packages.add(top)
            continue
        files[module] = path
        if path.suffix == ".py":
            waiting += _imports(module, path)
        if module in sys.modules:
            waiting += _bound(sys.modules[module])
    return files, packages


@cache
def _installed_folders() -> tuple[Path, ...]:
    """List the folders that installed packages and Python's own modules lie in."""
    folders = [*sysconfig.get_paths().values(), *site.getsitepackages(), site.getusersitepackages()]
    wanted = [Path(each).resolve() for each in folders if "packages" in each or each.endswith("lib-dynload")]
    return tuple(dict.fromkeys(wanted))


def _file_of(module: str) -> Path | None:
    """Find the file of a module; ``None`` for one without a file, or that is not there."""
    loaded = sys.modules.get(module)
    place = getattr(loaded, "__file__", None)
    if loaded is None:
        try:
            found = importlib.util.find_spec(module)
        except Exception:  # a package above it that cannot be imported is not part of the monitor
            return None
        place = found.origin if found is not None and found.has_location else None
    path = None if place is None else Path(place).resolve()
    return path if path is not None and path.is_file() else None


def _imports(module: str, path: Path) -> Iterator[str]:
    """Name what the import statements of a file ask for; ``from a import b`` may mean the module a.b."""
    try:
        tree = ast.parse(path.read_bytes())
    except (SyntaxError, ValueError):
        return
    package = module if path.name == "__init__.py" else module.rpartition(".")[0]
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (each.name for each in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = node.module or ""
            if node.level:
                above = package.split(".")[: len(package.split(".")) - node.level + 1]
                base = ".".join([*above, *([base] if base else [])])
            if base:
                yield base
                yield from (f"{base}.{each.name}" for each in node.names if each.name != "*")


def _bound(module: ModuleType) -> Iterator[str]:
    """Name the modules that the names in a module come from, however they got there."""
    for value in list(vars(module).values()):
        name = value.__name__ if isinstance(value, ModuleType) else getattr(value, "__module__", None)
        if isinstance(name, str) and name in sys.modules:
            yield name


def _package_version(package: str) -> str:
    try:
        return f"{package} {version(package)}"
    except PackageNotFoundError:
        return f"{package} {getattr(sys.modules.get(package), '__version__', '')}"
