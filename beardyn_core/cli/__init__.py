"""The ``beardyn`` command, a module for each subcommand.

================ ========================================================================
module           responsibility
================ ========================================================================
main             the parser, the list of subcommands, exit codes, complaints
command_parser   a parser that answers a mistake with a sentence
json_output      strict JSON with a version, for every ``--json``
files            inputs and outputs of a command: complaints at once, doubts, a folder to write
generated_parser parsers of commands from the functions of `api` that they call
options          options that several commands have
growth_option    the rate of growth of spalls, an option of several commands
quantities       numbers with units in options
demo             the main job in one go
scenes           what scenes, bearings, lubricants, vehicles, effects, trials and boxes there are
catalogue_list   bearings of the catalogue, all or those of some dimensions
catalogue_line   what a command says of the line of the catalogue that it took
new              a copy of a shipped file to start from
simulate         a desk run
simulate_train   the same of several axleboxes at once
import_          a recording of measured files
measured_options options of measured files and bearing data, from their declarations
explain          which effects a scene is computed with, why, and what each costs
ladder           what accuracy costs
warmup           kernels compiled ahead
view             a recording in 3-D
report           what a recording holds
report_page      a page about an axlebox: `beardyn report --html`, `--pdf`
monitor          what a monitor says over a recording
monitor_settings options that settle what the monitor assumes
monitored_files  the files of a command through a monitor
estimate         load, end play and spall of a recording, what remains
fleet            recordings of many axleboxes in a store: add, status, report, acknowledge, exchanged
follow           the same over successive stretches and recordings, health, measured minus twin
calibrate        the scene of one measured axlebox, fitted to its healthy recordings
export           signals of a recording as Parquet, CSV, NPZ, HDF5 or WAV
bearing          static answers about one bearing
bearing_options  load, end play and speed that they are for
bearing_report   geometry, fault frequencies and static solution as JSON
bearing_table    the same as text
structure        modes of an axlebox
trend            levels of many records: `beardyn monitor --trend`
which_bearing    bearings that fit a vibration: `beardyn monitor --which-bearing`
trial            a monitor over a matrix of scenes
contacts         the contact laboratory
sweep            sets of labelled runs over a population of bearings
baseline         a simple learner on such a set
train            an estimator of such a set
schema           JSON schemas for editors
================ ========================================================================
"""
