"""From nouns to numbers: what the kernels are given.

=============== ===========================================================
module          responsibility, in the order of the data
=============== ===========================================================
parameters      named tuples of kernel parameters; an absent effect is None
layout          where each number of the state stands
arrangement     which roller sits in which lane
lamina_table    what the laminae of a roller have of their own
..._params      parameters of one effect
film_factor     film thickness as factors for the kernel
springs         tables of laminae as springs
box_coupling    axlebox whose centre of mass or springs stand off the bearing
patch_path      path of a roller over a patch
heat            nodes of the thermal network and where losses go
build           a scene to parameters
tier_parameters parameters of the tiers without roller dynamics
=============== ===========================================================
"""
