"""Domains of graphs that begin at the same time in several processes."""

from __future__ import annotations

import subprocess
import sys

from beardyn_ros.processes import FIRST_DOMAIN, free_domain_id, release_domain_id

ASKS_FIRST_FOR = """
import os, sys
os.getpid = lambda: int(sys.argv[1])
from beardyn_ros.processes import free_domain_id
print(free_domain_id())
"""


def domain_of_another_process(wanted: int) -> int:
    words = [sys.executable, "-c", ASKS_FIRST_FOR, str(wanted - FIRST_DOMAIN)]
    return int(subprocess.run(words, capture_output=True, text=True, timeout=60, check=True).stdout)


def test_a_domain_belongs_to_the_first_that_asks_until_it_is_released() -> None:
    domain = free_domain_id()
    assert domain_of_another_process(domain) != domain
    assert free_domain_id() != domain
    release_domain_id(domain)
    assert domain_of_another_process(domain) == domain
