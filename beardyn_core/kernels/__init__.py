"""Forces and motion as lane code: one source for scalars, vectors and plain NumPy.

A contact is one file, its functions in the order of a step: prepare, stiffen, push, settle.

Arguments mean the same in all kernels; a function's own words tell what is special there:

- ``lanes``, ``block``, ``p``: the lane width, the block of rollers, and the parameters of the tier.
- Parameters of an effect bear its name (``rib``: `RibParams`) and are ``None`` where it is absent; ``cage``,
  ``roller``, ``damping`` and the like are the tuples of `model` too.
- ``rollers`` [block, ROLLER_FIELDS, lane], ``rings`` [ring, RING_FIELDS, lane], ``sums`` [1, SUM_FIELDS +
  3 x series, lane], ``bodies`` [body, BODY_STATES], ``wrenches`` [body, 6], ``energy`` [ENERGY_TERMS],
  ``flex`` [2, mode], ``laminae`` [LAMINA_ROWS, lamina]: C-contiguous float64 arrays, see `model.layout`.
- ``body``, ``view``, ``here``, ``change``: a `Body`, the `View` of the ring that it meets, `Here`, and the
  `Twist` of the roller over the step; ``step`` [s]; ``ring``: ``CUP`` or ``CONE``.
- ``centre``: centre of mass of the roller from the ring's origin [m]; ``axis``, ``ring_axis``: unit axes,
  towards the large end; ``oversize``: radius error of the roller [m].
- ``azimuths``: of the roller in the ring's frame, and of the contact in the roller's [rad]; ``cosine`` and
  ``sine`` are those of the orbit azimuth.

In the fast tiers, whose rollers stay in their meridian planes:

- ``direction``: cosine and sine of the cage angle; ``turns``: angle of cages, cone, and rollers in their
  pockets [rad]; ``speeds``: of shaft and cages [rad/s]; ``angle``: of the pocket [rad].
- ``place``: radius and axial place of the centre of mass [m]; ``axis``: its radial and axial part.
- ``motion``: from `relative_cone`; ``loads``: cup, cone and rib load [N].

================= ============================================================
module            responsibility, in the order of the data
================= ============================================================
lanes             the lane value, its arithmetic, load and store
lane_math         elementary and saturating functions with stated errors
lane_tables       tables in memory: two points in one look, what is needed soon
vectors           three-vectors of lane values, wrenches and twists
exchange          what a contact hands to rings, audit and outputs
orbit             motion of rollers in frames that turn with their orbit
solve             the 6x6 system of one roller
generator_line    contact line of a roller on a raceway
defect            gap over patches of raceways and rollers
waviness          gap of waviness; the force along a sloping gap
lamina_coupling   laminae that sink with each other, also partly over a patch
film              film thickness of a lamina
held              friction of a contact, worked out in every few steps
traction          friction of a lamina: dry, of a full film, of both
laminae           the springs of a raceway contact and their sums
raceway           contact of a roller with a raceway
structure         bending of the axlebox with the cup
rolling           couple against rolling
drag              medium around the rollers
point_contact     contact with the cone at a point, and the small rib
large_end         where the large end is nearest to the rib
rib               large end on the cone rib
pocket_film       lubricant between roller and bar
pocket            roller in its cage pocket
roller            one step of a block of rollers
bodies            cup, cone and cages as scalar rigid bodies, and the seals between them
cage_bodies       cages as bodies: free, following the rings, or prescribed
box               axlebox on its springs
axle              journal on an axle that bends
land              land of a cage in cup or cone
stage_timer       where the time of a step goes
lamina_springs    laminae as springs, summed (quasistatic tier)
balanced_roller   a roller between cup, cone and rib, implicit (quasistatic tier)
loose_rollers     rollers in the pockets of cages that turn and hang (quasistatic tier)
kinematic_rollers rollers that orbit kinematically, and their torque on the shaft
kinematic_rings   rings of the fast tiers on the springs of all rollers
kinematic_bending bending of the axlebox in the fast tiers
joint_bending     few modes and rigid rings together on the springs of rollers
rolling_waves     waviness under rollers that orbit kinematically (lumped tier)
spring_roller     a roller as one spring (lumped tier)
================= ============================================================
"""
