"""What `beardyn fleet` says of a fleet over a year, of runs to failure, and how much it takes.

======= =============================================================================
module  responsibility
======= =============================================================================
signals recordings of a year from a small set of short twin runs
year    a year of 64 axleboxes: who is found, how long before 20 mm, false alarms
page    docs/evidence/fleet_year.md
many    thousands of recordings of 500 axleboxes: time, memory, size of the store
failure runs to failure of PRONOSTIA through the fleet
======= =============================================================================
"""
