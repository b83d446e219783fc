"""The monitor on trial, on a page. The trial itself is a command, `beardyn trial`.

============== ==============================================================
module         responsibility
============== ==============================================================
page           docs/evidence/trial.md, its picture and docs/monitor.md
growth_picture what is found of spalls while they grow, as a picture
tiers          a spall in service in two tiers, and the noise that it stands out of
rivals         the reference, envelope and pre-whitening over the same runs
pockets        slip, spacing and lines of healthy bearings in two tiers
wide_spalls    why wide spalls of the cone are taken for strikes of the wheel
worn_pockets   what a worn pocket shows, and what else looks like it
============== ==============================================================
"""
