"""Hidden axleboxes played in the tier `full`, calibrated from their recordings alone: docs/estimate.md.

======== ==================================================================
module   responsibility
======== ==================================================================
hidden   axleboxes unlike the scene, their recordings, what `bd.calibrate` makes of them
page     truth beside fit, written into docs/estimate.md
======== ==================================================================
"""
