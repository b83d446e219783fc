"""The hard battery: situations in which such codes break, each with its guard and measured verdicts.

=================== =========================================================
module              responsibility, in the order of the data
=================== =========================================================
case                what a hard case is: scene, load, limits, expected reports
cases_load          loads: none, tiny, reversing, striking, enormous, no number
cases_speed         standing, starting, turning round, racing
cases_lubricant     cold, hot, starved, dry
cases_geometry      play, preload, tilt, rib, cage, numbers of rollers
cases_faults        spalls, dents, wrong rollers
cases_numerics      laminae, time steps, hidden chatter
cases_endurance     an hour, a minute, restarts
catalogue           all cases
case_scene          the scene and the load of a case
watch               what is measured of a run, block by block
refinement          statistics of two steps against each other
explicit_contact    one roller stepped explicitly: finite and not stable
coarse_step         the twin's own step made far too large
run                 a case from start to verdict, by how it is run
verdict             from measures and limits to a verdict, over all starts
battery             all cases side by side, resumable
report              table and JSON
page                writes docs/evidence/hard.md
=================== =========================================================
"""
