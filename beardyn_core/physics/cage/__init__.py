"""The cages: what rollers, rings and air do to them, and how they move.

====== ================================================================================
module responsibility
====== ================================================================================
pocket pockets: their films and lands as parameters, their contacts within a step
land   land of a cage in cup or cone
drag   torques of effects on the cages, against cup and cone
motion cages as bodies: free, following the rings, or prescribed
play   rollers in the pockets of cages that turn and hang (quasistatic tier)
====== ================================================================================
"""
