"""What tests of sweeps share: a small cluster, and a set that was made once."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from beardyn_core.experiments import Cluster
from beardyn_core.experiments.cluster import LocalCluster
from beardyn_core.experiments.loop import Progress
from beardyn_core.population.sweeping import conduct
from test.population.sweeps import planned


@pytest.fixture(scope="session")
def local() -> Iterator[LocalCluster]:
    """A scheduler with two workers that these tests share, as another machine's would be."""
    started = LocalCluster(2, None)
    yield started
    started.close()


@pytest.fixture(scope="session")
def cluster(local: LocalCluster) -> Cluster:
    return Cluster(scheduler=local.address, patience=60.0)


@pytest.fixture(scope="session")
def made(cluster: Cluster, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[Progress]]:
    """The tiny set, and what was told while it was made."""
    folder, told = tmp_path_factory.mktemp("set") / "tiny", list[Progress]()
    conduct(planned(), folder, cluster, report=told.append)
    return folder, told
