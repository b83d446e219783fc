"""What `effects: auto` chooses, against the converged reference of the ladder.

====== =======================================================
module responsibility
====== =======================================================
page   cases, their runs, and docs/automatic.md
====== =======================================================
"""
