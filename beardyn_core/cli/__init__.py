"""The ``beardyn`` command: `main` dispatches, every other module is one subcommand.

======== ===============================================================
module   responsibility
======== ===============================================================
main     command line to subcommand; errors to exit codes
simulate a desk run of a scene, recorded if asked for
demo     the main job in one process, without ROS
explain  which effects are on, why, and what each costs
bearing  geometry, fault frequencies, load distribution, stiffness, life
ladder   what accuracy costs, for one scene
trial    a monitor on trial over a matrix of scenes
monitor  what a monitor says over a finished recording
contacts the general contact search beside closed forms
view     a recording in 3-D with its curves
report   what a recording holds; a cut-off one is recovered
schema   JSON schema of the configuration files
warmup   compiles the kernels of scenes ahead of their first run
======== ===============================================================
"""
