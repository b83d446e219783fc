"""Where each number of the state stands in the kernel arrays.

Rollers are kept as ``[block, field, lane]``: lanes 0..W/2-1 hold rollers of row 0, the others of row 1.
Each row is written in its own ring frame (radial at azimuth 0 = +z, then +x, then the row's outward
axis); the frame of row 0 is the mirror image of the world in the plane between the rows, so both rows
look alike and share every kernel. Vectors of a roller are components in its orbit frame: radial,
tangential (towards growing azimuth), axial (outward).
"""

from __future__ import annotations

# --- roller state
RADIUS = 0  # radial place of the centre of mass from the cup's centre line [m]
ANGLE = 1  # orbit azimuth [rad]
AXIAL = 2  # axial place from the bearing's middle plane [m]
VELOCITY = 3  # 3 components of the centre-of-mass velocity [m/s]
AXIS = 6  # 3 components of the roller axis, towards the large end
MOMENTUM = 9  # 3 components of the angular momentum about the centre of mass [N m s]
SPIN = 12  # rotation about the own axis relative to the orbit frame [rad]
ROLLER_STATES = 13

# --- what the last step gives of each roller: per contact 8 fields
CONTACT_OUTPUT = 13
OUTPUT_FORCE = 0  # 3 components of the force on the roller [N]
OUTPUT_ARM = 3  # 3 components from the centre of mass to the contact [m]
OUTPUT_SLIP = 6  # slip speed [m/s]
OUTPUT_FILM = 7  # film thickness [m]
OUTPUT_FIELDS = 8
CUP, CONE, RIB, POCKET = range(4)

# --- friction memory for the chatter index: per raceway 4 fields
CHATTER = CONTACT_OUTPUT + 4 * OUTPUT_FIELDS
CHATTER_LAST = 0  # friction of the last step [N]
CHATTER_BEFORE = 1  # friction of the step before [N]
CHATTER_SQUARES = 2  # sum over the block of the squares of what flips [N^2]
CHATTER_LOAD = 3  # sum over the block of the squared traction capacity [N^2]
CHATTER_FIELDS = 4
PENETRATION = CHATTER + 2 * CHATTER_FIELDS  # largest raceway approach of the block [m]
LARGEST = PENETRATION + 1  # squares of the largest loads since the last snapshot: cup, cone, rib [N^2]
LARGEST_FIELDS = 3
ROLLER_FIELDS = LARGEST + LARGEST_FIELDS

TRENDS_PER_SNAPSHOT = 2  # bodies and contacts are shown at every second instant of the trends

# --- roller constants [block, field, lane]
MASK = 0  # 1 for a real roller, 0 for a filler lane that shadows one
POCKET_ANGLE = 1  # place of its pocket in the cage [rad]
OVERSIZE = 2  # radius error [m]
ROLLER_CONSTANTS = 3

# --- rigid bodies, world axes [body, field]
CUP_BODY, CONE_BODY, CAGE_BODY = 0, 1, 2  # cages 2 and 3
POSITION = 0  # 3, from the place at rest [m]
TILT = 3  # 3, rotation vector without the spin [rad]
LINEAR = 6  # 3, velocity [m/s]
ANGULAR = 9  # 3, angular velocity without the spin [rad/s]
TURN = 12  # spin angle about the own axis, +y [rad]
RATE = 13  # spin speed about the own axis [rad/s]
CHANGE = 14  # 6, of LINEAR and ANGULAR over the last step: full tier, cup and cone; quasistatic, cup
BODY_STATES = 20

# --- ring data as the rollers see them, lanes [ring, field, lane]; order of rings: cup, cone, cage
RING_ORIGIN = 0
RING_AXIS = 3
RING_VELOCITY = 6
RING_OMEGA = 9
RING_TURN = 12
RING_DRIFT = 13  # velocity of the origin over the step that ends
RING_FIELDS = 16

# --- where energy is lost
LOSS_SLIDING, LOSS_DAMPING, LOSS_ROLLING, LOSS_RIB, LOSS_SMALL_RIB, LOSS_POCKET = range(6)
LOSS_LAND, LOSS_DRAG, LOSS_SEAL, LOSS_SUSPENSION, LOSS_STRUCTURE = range(6, 11)  # others: `losses`
ROLLER_LOSSES = LOSS_DRAG + 1  # the first of them are summed over the rollers

# --- sums over the rollers, lanes [0, field, lane]
REACTION = 0  # 3 rings x (force, moment)
WORK_LOST = 18  # dissipated energy of the step by source, ROLLER_LOSSES fields [J]
WORK_NUMERICAL = WORK_LOST + ROLLER_LOSSES
WORK_GRAVITY = WORK_NUMERICAL + 1
ELASTIC = WORK_NUMERICAL + 2  # elastic energy at the beginning of the step [J]
LOST_ON_CAGE = WORK_NUMERICAL + 3  # 6: lost part of the pockets' wrench on the cage [N, N m]
SUM_FIELDS = LOST_ON_CAGE + 6  # then, with a structure, forces on the series around the raceways

# --- signals of every step [step, channel]
SIGNAL_FORCE = 0  # 6: rollers on the cup, about the bearing centre [N, N m]
SIGNAL_ACCELERATION = 6  # 3: of the axlebox [m/s^2]
SIGNAL_ANGULAR_ACCELERATION = 9  # 3 [rad/s^2]
SIGNAL_TORQUE = 12  # bearing on the shaft, about +y [N m]
SIGNAL_CHANNELS = 13  # then, with the modes of a box, 3 for each sensor: acceleration of its seat

# --- energy terms since the start [J]
ENERGY_ELASTIC, ENERGY_KINETIC, ENERGY_EXTERNAL, ENERGY_NUMERICAL, ENERGY_LOST = range(5)
ENERGY_WORKS = ENERGY_EXTERNAL  # works from here on, ENERGY_TERMS in all; ENERGY_LOST by source, see `losses`

# --- lamina table [row, lamina]; film and pressure have one row each for cup and cone
LAMINA_PLACE, LAMINA_DROP, LAMINA_STIFFNESS, LAMINA_RADIUS = range(4)
LAMINA_FILM, LAMINA_PRESSURE = 4, 6
LAMINA_ROWS = 8

# --- friction held of a raceway contact [2 x block + ring, field, lane]
HELD_FROM = 0  # 1 in the lanes that pressed when the memory was filled
HELD_COUPLE = 1  # against rolling [N m]
HELD_COEFFICIENT = 2  # of each lamina: friction over slip speed and load [s/m]

# --- work space of coupled laminae [row, lamina, lane]
COUPLING_ROWS = 5

# --- patches [patch, field]: centre [rad], repeats a turn, radius [m], that by repeats, reach, cells a metre
PLACE_AZIMUTH, PLACE_REPEATS, PLACE_RADIUS, PLACE_ARC_RADIUS, PLACE_REACH, PLACE_SCALE = range(6)
PATCH_FIELDS = 6
PATCH_POINTS = 258  # of a path: 256 cells and one point beyond

# --- springs near a patch (intact or damaged part of a lamina) [0, spring x field, lane]
# firmness is that of the intact surface under a patch's sharp edges, the softening its relative loss
SPRING_SHARE, SPRING_GAP, SPRING_FIRMNESS = range(3)
SPRING_RING_SLOPE, SPRING_RING_SOFTENING = 3, 4
SPRING_ROLLER_SLOPE, SPRING_ROLLER_SOFTENING = 5, 6
SPRING_FIELDS = 7

# --- directions of the pockets [block, field, lane]; the mask of the rollers, alone and times these
POCKET_COSINE, POCKET_SINE, COUNTED, COUNTED_COSINE, COUNTED_SINE = range(5)
