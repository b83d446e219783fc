"""From nouns to numbers: what the kernels are given.

<<<<<<< HEAD
=========== ===========================================================
module      responsibility, in the order of the data
=========== ===========================================================
parameters  named tuples of kernel parameters; an absent effect is None
layout      where each number of the state stands
arrangement which roller sits in which lane
film_factor film thickness as factors for the kernel
build       a scene to parameters
=========== ===========================================================
=======
=============== ===========================================================
module          responsibility, in the order of the data
=============== ===========================================================
parameters      named tuples of kernel parameters; an absent effect is None
layout          where each number of the state stands
arrangement     which roller sits in which lane
film_factor     film thickness as a plain formula and as a table entry
build           a scene to parameters
tier_parameters parameters of the tiers without roller dynamics
=============== ===========================================================
>>>>>>> w-tiers
"""
