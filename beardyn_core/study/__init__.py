"""What is done with a twin on the desk.

=================== ==========================================================================================
module              responsibility, in the order of the data
=================== ==========================================================================================
desk_run            a scene from start to end, with its means
monitored_recording a monitor beside a recording, or over one
finding             a monitor's result in words and messages
summary_picture     one picture of a run
demo_console        arguments and progress of the demo
demo_report         what the demo prints and draws
trial_run           one run of a trial of a monitor
trial               all its runs, kept and taken up again
trial_result        rates with intervals, smallest sizes
trial_report        table and JSON; trial_picture draws it
life_text           rating life in words
output_folder       whether the folder of --output can be written to
hard                the battery of hard cases
ancestor            the runs of BearDyn (2017) again
contacts_tables     the contact laboratory as tables; contacts_report and contacts_picture show them
ladder              tiers, effects, laminae and steps against a reference; ladder_* judge, print and draw it
=================== ==========================================================================================
"""
