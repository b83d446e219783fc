"""Estimates of what no sensor measures: load, end play, width of a spall, each with an interval.

=================== ======================================================================================
module              responsibility
=================== ======================================================================================
entry_exit_features what repeats with the passages of a fault
passage_profile     the mean envelope over a passage, and its correlations
event_order         which of the two events of a passage is entry and which exit, by the motion of the box
descriptors         what is worked out of a stretch of signal
quantities          what is estimated, on which scale, and by which label of a run it is learnt
conformal           numbers with intervals that hold their promise
wide_spall          whether a spall is wider than half of the distance of two rollers
regression          numbers from descriptors by kernel ridge regression
forest              numbers from descriptors by trees
fault_location      which part is spalled, with sets of parts that hold their promise
familiarity         whether runs are of the kind learnt from: another box lies far from them
mounting            a mounting of a sensor that is not as stated, in words, and over several recordings
estimator           the numbers that make an estimator, its card, and the file that keeps them
mounting_search     what must be undone of a mounting for a strange signal to be familiar
mounting_watch      when a search of the mounting is due over the latest stretches, and its finding
inference           what an estimator makes of a run
shipped             estimators that are shipped
estimator_choice    the user's own or the shipped estimator of a bearing, or the command that makes one
live_choice         the same while the axes that are measured show block by block
growth              how a spall grows with mileage, with its scatter
service             what a forecast must know: mileage, wheel, widest spall
known_load          a vertical load that somebody knows, stated or of several sources that must agree
load_sensors        air spring, primary spring and weighing site as loads on a journal
load_checks         what bearing, lateral load, speed and vehicle say against a load that is stated
conditioning        a known load among the estimates of a run
life_surface        rating lives over load, lateral load, viscosity ratio and contamination, interpolated
life_assumptions    what a rating life assumes of lubricant, cleanliness and load between
rated_life          rating life and share used under a known load, with intervals
forecast            mileage until a spall is too wide, share of the rating life that is used
labelled            runs of a set of labelled runs as an estimator sees them
cubature_filter     means and covariances, carried on and corrected
condition           which part is spalled, believed over many stretches
following           the filter of one bearing: load, end play, spall as they change
run_stretches       the stretches of a run as the filter of its bearing takes them
residual            measured minus twin, in the state that is known
follower_values     a step as numbers that any tool plots
estimate_json       estimates, steps and residuals for JSON
windowing           stretches out of blocks as they come
learning            numbers and condition from labelled runs, intervals from runs not learnt from
judging             errors and coverage on runs that were neither learnt from nor calibrated with
training            an estimator of a set of runs, with its card
=================== ======================================================================================

scikit-learn is imported by `learning` and `familiarity` alone and when it is needed; an estimate needs NumPy.
"""
