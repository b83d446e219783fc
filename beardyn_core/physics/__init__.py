"""Forces and motion: an idea a file, with its parameters, the builder from the scene and the compiled part.

A contact is one file, its functions in the order of a step: prepare, stiffen, push, settle.

Arguments mean the same in all kernels; a function's own docstring has what is special there:

- ``lanes``, ``block``, ``p``: the lane width, the block of rollers, and the parameters of the tier.
- Parameters of an effect bear its name (``rib``: `RibParams`) and are ``None`` where it is absent; ``cage``,
  ``roller``, ``damping`` and the like are the tuples of their files too.
- ``rollers`` [block, ROLLER_FIELDS, lane], ``rings`` [ring, RING_FIELDS, lane], ``sums`` [1, SUM_FIELDS +
  3 x series, lane], ``bodies`` [body, BODY_STATES], ``wrenches`` [body, 6], ``energy`` [ENERGY_TERMS],
  ``flex`` [2, mode], ``laminae`` [LAMINA_ROWS, lamina]: C-contiguous float64 arrays, see `bodies.layout`.
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

================== ================================================================================
module             responsibility
================== ================================================================================
slow_thermal       slow warming next to the fast motion
scatter            scatter as numbers of each roller
lamina_table       table of the laminae
hertz_pressure     largest pressure of the contacts from their loads
laminae            the springs of a raceway contact and their sums
lamina_springs     laminae as springs, summed (quasistatic tier)
lamina_coupling    laminae that sink with each other, also partly over a patch
raceway            contact of a roller with a raceway
generator_line     contact line of a roller on a raceway
barrel_line        contact line of a barrel on the spherical cup or on a groove of the cone
slice_law          how a slice presses: after Palmgren, or as part of Hertz's ellipse of a barrel
point_contact      contact with a ring at a point, which all ribs share
waviness           waviness: its tables, its gap, and the force along a sloping gap
rolling_waves      waviness under rollers that orbit kinematically (lumped tier)
thermal            nodes of the thermal network and where losses go
traction           friction of the raceway contacts: the law that is chosen, asperities with film
dry_friction       dry friction, its corner at zero slip rounded
film_traction      traction of full films
film               film of the raceway contacts
rib                large roller end on its rib
rib_gap            where it is nearest to the rib: a sphere and its rim on a cone
rib_friction       its film and friction
small_rib          small roller end on its rib: a plane on a circle
flanges            ends of cylindrical rollers on the ribs of both rings
defect             patches, wear and size errors: tables, and the gaps they make
patch_path         path of a roller over a patch, and how its sharp edges give way
roller_spring      a roller as one spring along the cup's normal
spall_cover        share of each lamina that counts as lost over a patch, from the half-space
journal            bending of the axle at the journal
modal_body         how the axlebox bends: thin rings or the modes of a table
ring_modes         bending of the axlebox within a step
suspension         what holds the box, or both rings
pure_rolling       speeds and places of rollers that roll without slip
drag               medium around the rollers
rolling_resistance couple against rolling
contact_damping    damping of every Hertz contact, and how much of it a step takes
oscillators        steps of a mode with its exact free motion
lanes              lane values: arithmetic, functions, vectors, the system of a roller
bodies             shared: layout of the state, lanes of rollers, rigid bodies, what contacts write
statics            equilibrium, torque and life, in NumPy
cage               the cages: pockets, lands, drag, and their motion
tiers              parameters, state and steps of full, quasistatic and lumped
seal               seals between cup and shaft
================== ================================================================================
"""
