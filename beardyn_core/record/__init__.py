"""Recording and viewing: the topic table, its messages, MCAP files, and the rerun view.

In the order of the data:

================= =============================================================================
module            responsibility
================= =============================================================================
topics            the one topic table: names, types, QoS
messages          CDR bytes without ROS; templates for small messages; diagnostics, clock, text
plot_values       results of monitor and follower as numbers that any tool plots
plot_samples      every sample of vibration in an array that Foxglove plots
cloud_layout      columns of a cloud from its bytes, checked and without a copy
clouds            columns of samples as ``sensor_msgs/PointCloud2`` and back
encoding          a `Block` as the messages of the topic table
load_stream       load histories as messages of ``load/blocks`` and back
load_reading      load and speed of a recording, for an operation from a file
checking          whether a message is what its topic promises
description       what a run says about itself (the content of ``truth``)
sinks             where blocks go: memory, MCAP, one file for several axleboxes
background_file   a file that a slow disk does not hold up
bag_metadata      what rosbag2 wants to know of a recording
chunk_reading     chunks unpacked within bounds
chunk_writing     chunks of many messages at once
mcap_writing      crash-safe MCAP that rosbag2 reads
mcap_scanning     reading that survives a cut file
other_messages    numbers in the messages of other tools, and whose a file is
bag_scanning      the files of a recording in several, and whichever of both a path means
bag_writing       a recording split by size and time into a folder with an index
arrays            the arrays of a run: signals, angles, bodies, contacts, load
run               a run as named arrays, whatever it comes from
message_source    the arrays of a run from its messages, decoded at the first look
reading           the messages of a recording as a run, one of each of its axleboxes
block_source      the blocks of a simulation as a run
tables            the signals of a run as columns, as xarray and as pandas
exporting         signals of a run to Parquet, CSV, NPZ, HDF5 and WAV
stamp_offset      offset of stamps over simulated time, where they are those of a train's clock
published         what a twin says it has published, compared with what is recorded
run_summary       the summary of a recorded run
reporting         what a recording holds, in words and as JSON
envelope_spectrum envelope order spectrum of a whole recording
load_colours      colour of a roller by its load, and of the parts
view_title        title of a view, with faults in the other axleboxes
meshes            triangle meshes of the bearing's parts from its recorded shape
rerun_bearing     the bearing in 3-D: motion, loads, contact forces
rerun_scale       scale of the colours, key of the arrows, round axes
rerun_plots       curves next to it, and the envelope spectrum
rerun_follower    what a follower says over time, measured next to twin
rerun_values      numbers of the monitor over time
rerun_view        a whole recording with its blueprint; where it goes: a window, a page, a file
rerun_live        a running twin, fed with messages
rerun_modes       modes of an axlebox in motion
viewer            the rerun program: window, web page, picture without a screen
================= =============================================================================
"""
