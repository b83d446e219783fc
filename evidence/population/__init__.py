"""Sets of labelled runs: how fast they are made, and how far a learner trained on them gets.

======== ==================================================================
module   responsibility
======== ==================================================================
sets     the sets that the learner is trained and tested on
causes   what the learner's errors come from
measured public records, and their features
scale    throughput of the engine, memory, size and reading of formats
page     the part of docs/evidence/learner.md that is measured, and its picture
======== ==================================================================
"""
