"""Forces and motion as lane code: one source for scalars, vectors and plain NumPy.

================= =========================================================
module            responsibility, in the order of the data
================= =========================================================
lanes             the lane value, its arithmetic, load and store
lane_math         elementary functions with stated errors
vectors           three-vectors of lane values
saturation        saturating functions over their argument
orbit             motion of rollers in frames that turn with their orbit
raceway           laminated roller on a conical raceway
lamina_spring     the spring of a lamina, sound or damaged
lamina_coupling   laminae that sink with each other
joint_lamina      one of them that lies partly over a patch
film              film thickness of a lamina
traction          friction of a lamina
slip_laws         dry friction near zero slip: laws that round its corner
film_traction     traction of a full film
defect            gap over patches of raceways and rollers
waviness          gap of waviness; the force along a sloping gap
rib               large end on the cone rib
rib_gap           where the large end meets the rib, its edges and the rim
rib_friction      film and friction of the rib contact
small_rib         small roller end at the small rib of the cone
pocket            roller in its cage pocket
pocket_film       lubricant between roller and cage bar
pocket_simple     pockets of the cheaper cages
rolling           couple against rolling, and its part of a step
drag              medium around the rollers, and its part of a step
exchange          what a contact hands to rings, audit and outputs
raceway_step      the raceway contact within a step
rib_step          the rib contact within a step
pocket_step       the pocket contact within a step
solve             the 6x6 system of one roller
roller            one step of a block of rollers
bodies            cup, cone and cages as scalar rigid bodies
cage_bodies       cages as bodies: free, following the rings, or prescribed
box               axlebox on its springs
ring_flexibility  bending of the cup
land              land of a cage in cup or cone
seal              seals between cup and shaft
balanced_roller   a roller in balance (quasistatic tier)
balanced_springs  its laminae as springs
kinematic_rollers rollers that orbit kinematically
kinematic_rings   rings of the fast tiers on the springs of all rollers
spring_roller     a roller as one spring (lumped tier)
kinematic_torque  torque of rollers in pure rolling, by lost power
stage_timer       cycle counter between the stages of a step
================= =========================================================
"""
