"""Forces and motion as lane code: one source for scalars, vectors and plain NumPy.

================= ============================================================
module            responsibility, in the order of the data
================= ============================================================
lanes             the lane value, its arithmetic, load and store
lane_math         elementary functions with stated errors
vectors           three-vectors of lane values
saturation        functions that saturate, divided by their argument, for arguments from zero on
orbit             motion of rollers in frames that turn with their orbit
raceway           laminated roller on a conical raceway
lamina_coupling   raceway laminae that sink with each other: the surface beside a loaded lamina follows it
film              film thickness of a lamina
traction          friction of a lamina
slip_laws         dry friction near zero slip: the laws by which its sharp corner is rounded, as force over slip speed
film_traction     traction of a full elastohydrodynamic film: friction force of a lamina over its slip speed
defect            gap over patches of raceways and rollers
waviness          gap of waviness; the force along a sloping gap
rib               large end on the cone rib
rib_gap           where the large roller end meets the rib: sphere, rib face with its edges, rim of the roller end
rib_friction      film and friction of the rib contact
small_rib         small roller end at the small rib of the cone: the flat end against a circle of the rib
pocket            roller in its cage pocket
pocket_film       lubricant between a roller and a cage bar: a rigid line contact with a bounded thickness
pocket_simple     pockets of the cheaper cages: two touches instead of five, along the pitch circle only
rolling           couple against rolling, and its part of a step
drag              medium around the rollers, and its part of a step
exchange          what a contact hands to rings, audit and outputs
raceway_step      the raceway contact within a step
rib_step          the rib contact within a step
pocket_step       the pocket contact within a step
solve             the 6x6 system of one roller
roller            one step of a block of rollers
bodies            cup, cone and cages as scalar rigid bodies
cage_bodies       motion of the cages as bodies: free, turning with the rings' mean place, or prescribed
land              land of a cage in a cylinder of cup or cone: short journal bearing, and solid contact at both edges
seal              seals between cup and shaft
balanced_roller   a roller in balance (quasistatic tier)
kinematic_rollers rollers that orbit kinematically
spring_roller     a roller as one spring (lumped tier)
================= ============================================================
"""
