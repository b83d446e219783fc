"""The scene of one measured axlebox: what no drawing states, fitted to its healthy recordings.

================== ===============================================================
module             responsibility, in the order of the data
================== ===============================================================
unknowns           what is fitted, its range, and the key that it is written to
intake             recordings and a scene that fit each other, or why they do not
spectra            levels of stretches, put together by speed, and their tolerance
twin               the same of a twin at values of the unknowns
search             an evolution strategy over the unknowns
identify           what the recordings determine, with intervals
fitting            the whole fit
writing            the scene of the axlebox, with what is known of each number
calibration_result what a calibration has come to
================== ===============================================================

The library of the search (`cma`) is imported by `search` alone and when it is needed.
"""
