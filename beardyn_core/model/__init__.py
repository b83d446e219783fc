"""From nouns to numbers: what the kernels are given.

================== =============================================================
module             responsibility, in the order of the data
================== =============================================================
parameters         named tuples of kernel parameters; an absent effect is None
contact_parameters their tuples: raceway contacts
guide_parameters   their tuples: ribs and cages
fault_parameters   their tuples: patches and waviness
layout             where each number of the state stands
arrangement        which roller sits in which lane
aligned            arrays of lane values on cache lines
stages             stages of a time step, for the stage timer
lamina_table       what the laminae of a roller have of their own
traction_params    traction
loss_params        rolling resistance, drag, seals
coupling_params    coupled laminae
rib_params         the rib contact
small_rib_params   the small rib
cage_params        cage pockets and lands
flexibility_params bending of the cup
fault_params       patches and their growth
waviness_params    waviness as periodic gap tables
film_factor        film thickness as factors for the kernel
springs            tables of laminae as springs
spring_share       how much of a spring's change over a step the step takes in
box_coupling       axlebox whose centre of mass or springs stand off the bearing
patch_path         path of a roller over a patch
heat               nodes of the thermal network and where losses go
build              a scene to parameters
tier_parameters    parameters of the tiers without roller dynamics
================== =============================================================
"""
