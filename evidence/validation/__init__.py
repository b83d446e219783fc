"""Published numbers and trends beside ours: what the tests assert and the validation page lists.

================ ===================================================================
module           responsibility
================ ===================================================================
anchor           a published number or trend, and ours
statics          load zones, static equilibrium, stiffness, roller bounce
roller_loads     how many rollers of an axlebox bearing carry on a rig
kind_solutions   cylindrical and spherical bearings solved apart from the equilibrium
roller_kinds     cylindrical and spherical bearings against these and catalogues
runs_of_kinds    runs of these beside such solutions: loads, speeds of cages
wheel_waves      roller loads over the frequency at which waves of a wheel shake
zhang            the bearing and the model of Zhang et al. (2023)
load_zone        load-zone integrals of one row under rigid rings
ball_contact     films, rolling couples and curvatures of ball contacts
contact          closed-form contact points against a search
films            film thickness, mixed friction, inlet heating, traction
losses           rolling resistance, torque, power loss
rigs             torque of single rows on rigs
heat             torque and temperature of whole axlebox bearings
catalogue_values load ratings, fault frequencies, viscosities
life             rating life
dynamics         mean forces, cage speed, energy, wall time
posture          skew and tilt of the rollers under a load
trends           how skew and tilt change with load, speed and temperature
cage_whirl       the path of a cage's centre
whirl            how cage whirl changes with speed and load
skid             cage slip at light load
spalls           impacts of spalls as a ringing axlebox receives them
rail             standard deviation of track irregularities
wheelset         modes of a wheelset, levels of axlebox vibration
every            all of them, in the order of the page
pictures         small plots of the page
page             writes docs/evidence/validation.md and its pictures
================ ===================================================================
"""
