"""From nouns to numbers: what the kernels are given.

================ ===========================================================
module           responsibility, in the order of the data
================ ===========================================================
layout           where each number of the state and the tables stands
stages           stages of a time step, and the counters of what they take
arrangement      which roller sits in which lane; arrays on cache lines
parameters       named tuples of kernel parameters; an absent effect is None
laminae          table of the laminae, and their coupling
film             film of the raceway contacts
traction         friction of the raceway contacts
losses           rolling resistance, drag and seals
ribs             ribs at both roller ends
cage             pockets, lands and cheaper cages
scatter          scatter as numbers of each roller
patch_path       path of a roller over a patch, and how its sharp edges give way
faults           patches, waviness, wear and size errors
structure        bending of the axlebox: rings or modes of a table
journal          bending of the axle at the journal
mounting         rings, suspension
heat             nodes of the thermal network and where losses go
build            a scene to parameters; how much of a spring a step takes in
tier_parameters  parameters of the tiers without roller dynamics
tier_bending     bending of the axlebox in these tiers
tier_waves       waviness as the rollers of the lumped tier meet it
================ ===========================================================
"""
