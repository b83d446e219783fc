"""What a train does with its signals: from vibration and speed to a verdict; nothing of the twin is read.

================= ====================================================================
module            responsibility
================= ====================================================================
features          envelope, order tracking, spectrum, line search
rotation_segments times in which the shaft turns one way, put together
passage_order     the order at which a fault is passed, near the nominal one
severity          how wide a spall is, from entry and exit of the rollers
speed             speed of the shaft from the vibration itself
speed_lines       what lines of a vibration say of a speed
speed_rivals      other speeds that the same lines fit
trend             levels of many records against the bearing's own baseline
streaming         the streaming monitor around an algorithm, and what it is fed with
chain             the reference monitoring algorithm: a stretch of signal to a verdict
bearing_search    which of many bearings the combs of a vibration fit
================= ====================================================================
"""
