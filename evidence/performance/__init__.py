"""Speeds on a page. They are measured by `benchmarks` (`make bench`).

====== ==============================================================
module responsibility
====== ==============================================================
page   goals beside what was measured: docs/performance.md, docs/evidence/speed.md
====== ==============================================================
"""
