"""The cages: what rollers, rings and air do to them, and how they move.

=========== ==================================================================
module      responsibility
=========== ==================================================================
parameters  parameters of a cage: its pockets, and what else there is of it
step_bounds how much a cage may be resisted, which follows explicitly
pocket      contact of a roller with its pocket, and its simplified forms
walls       walls of a pocket, summed
pocket_film lubricant between rollers and bars
pocket_wear what wear and scatter add to the clearance of each pocket
land        land of a cage in cup or cone
drag        torques of effects on the cages, against cup and cone
motion      cages as bodies: free, following the rings, or prescribed
play        rollers that move in the pockets of cages (quasistatic tier)
watch       speeds of the cages over those of pure rolling
rubbing     friction of the pockets where rollers have no dynamics
=========== ==================================================================
"""
