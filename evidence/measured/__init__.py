"""What the monitor says of measured data: faults record by record, runs to failure, widths of spalls.

================== ===================================================================
module             responsibility
================== ===================================================================
cases              the records: faulty part, bearing, speed, and how they are read
grades             how well the faults can be diagnosed at all, as published
run                monitors over the records, and what is right, wrong or missed
page               docs/evidence/monitor_measured.md
wrong_inputs       docs/evidence/monitor_wrong_inputs.md: the monitor given a wrong speed or a wrong bearing
confidence         docs/evidence/confidence.md: how often verdicts are right, weights of confidence
speed              how often the interval of the speed from vibration holds, on records it was not fitted on
bearing_ranks      at which place the true bearing is among those that fit a record
cycbd              blind deconvolution, aimed at an order
spectra            other spectra than the chain's, on the part for choosing
run_to_failure     docs/evidence/run_to_failure.md: when the trend alarms
levels             docs/evidence/levels.md: how loud faults of known size are, beside the twin's
spall_width        docs/evidence/spall_width.md: widths found, of known ones
texture            docs/evidence/beside_measured.md: records next to runs of the twin
own_records        recordings of one's own train for that page, by a table
twin_runs          the twin's runs for that page
texture_quantities quantities of one axis: octaves, kurtosis, envelope, ring-down, wander
================== ===================================================================
"""
