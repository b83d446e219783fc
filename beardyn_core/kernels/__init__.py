"""Forces and motion as lane code: one source for scalars, vectors and plain NumPy.

============ ======================================================
module       responsibility, in the order of the data
============ ======================================================
lanes        the lane value, its arithmetic, load and store
lane_math    elementary functions with stated errors
vectors      three-vectors of lane values
orbit        motion of rollers in frames that turn with their orbit
raceway      laminated roller on a conical raceway
film         film thickness of a lamina
traction     friction of a lamina
defect       gap over patches of raceways and rollers
waviness     gap of waviness; the force along a sloping gap
rib          large end on the cone rib
pocket       roller in its cage pocket
rolling      couple against rolling, and its part of a step
drag         medium around the rollers, and its part of a step
exchange     what a contact hands to rings, audit and outputs
raceway_step the raceway contact within a step
rib_step     the rib contact within a step
pocket_step  the pocket contact within a step
solve        the 6x6 system of one roller
roller       one step of a block of rollers
bodies       cup, cone and cages as scalar rigid bodies
seal         seals between cup and shaft
============ ======================================================
"""
