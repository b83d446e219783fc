"""What accuracy costs: the ladders of three scenes. The ladder itself is a command, `beardyn ladder`.

====== =======================================================
module responsibility
====== =======================================================
page   climbs the ladders, writes docs/evidence/ladder.md and its pictures
front  writes the efficient levels of one scene into README.md
turns  what the levels of a scene cost, measured in turns
====== =======================================================
"""
