"""Forces and motion as lane code: one source for scalars, vectors and plain NumPy.

================== ======================================================
module             responsibility, in the order of the data
================== ======================================================
lanes              the lane value, its arithmetic, load and store
lane_math          elementary functions with stated errors
vectors            three-vectors of lane values
orbit              motion of rollers in frames that turn with their orbit
raceway            laminated roller on a conical raceway
film               film thickness of a lamina
traction           friction of a lamina
defect             gap over spalls
rib                large end on the cone rib
pocket             roller in its cage pocket
exchange           what a contact hands to rings, audit and outputs
raceway_step       the raceway contact within a step
rib_step           the rib contact within a step
pocket_step        the pocket contact within a step
solve              the 6x6 system of one roller
roller             one step of a block of rollers
bodies             cup, cone and cages as scalar rigid bodies
kinematic_rollers  rollers that orbit kinematically
spring_roller      a roller as one spring (lumped tier)
balanced_roller    a roller in balance (quasistatic tier)
================== ======================================================
"""
