"""Moving pictures of a recording: the load zone turning, and a roller that crosses a spall.

================= =============================================================================
module            responsibility
================= =============================================================================
row_motion        places, turns and loads of the rollers of a row at any time
spall_passages    when rollers pass a spall of a ring, and which passage is worth showing
cross_section     a row of rollers in cross-section, in motion
spall_close_up    rollers that pass a spall, magnified
load_zone_picture the load zone: cross-section, load by azimuth, load of one roller
moving_figure     a figure of which some parts move, and its frames
crossing_picture  a spall: cross-section, close-up, vibration with the strikes
picture_file      frames as a GIF or an MP4 file, and what is in them in a line
================= =============================================================================
"""

SUBJECTS = ("load_zone", "crossing")  # what a moving picture shows
