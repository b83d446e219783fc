"""Studies with a twin at the desk: runs, ladders, trials, demonstrations, and their reports.

=================== =============================================================================
module              responsibility
=================== =============================================================================
desk_run            a scene from start to end, with its means
train_run           several axleboxes at once, in a few threads
monitored_recording a monitor next to a recording, or over one; its results in words and messages
inspection          a bearing as a monitor has judged it, with the signals behind
report_page         a page about each inspected bearing, as HTML and PDF
monitor_picture     the envelope spectrum behind the verdicts of a monitor
summary_picture     one picture of a run
plot_axes           drawing of `beardyn_core.plot`
animation           moving pictures of a recording
demo_console        arguments and progress of the demo
demo_report         what the demo prints and draws
measured_severity   how wide the spall is that a monitor found in a run
smallest_spall      the smallest spall that a monitor would have found in a healthy record
fitting_bearing     bearings of the catalogue that fit a run or measured files
compiling           kernels compiled once on a machine, whatever processes want them
trial               its runs with a monitor next to each, kept and taken up again
trial_result        rates with intervals, smallest sizes
trial_report        a trial as table and JSON
trial_picture       a trial in one picture
measures            signals of a run in one piece, and the numbers by which runs are compared
ladder_levels       the levels of a ladder: tier, effects, laminae, step; their expected cost
ladder              all levels of a scene against a converged reference
level_run           load and windows of an accuracy study, and one run of a level
ladder_store        runs of an interrupted study, from which it goes on
ladder_result       errors of a level with the scatter between runs; levels that meet an accuracy
ladder_report       a ladder as table and JSON
ladder_picture      accuracy against wall time in one picture
table               tables for the terminal and for pages, numbers in few digits
=================== =============================================================================
"""
