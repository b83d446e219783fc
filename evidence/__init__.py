"""Evidence behind the documentation: a folder for each page, with its cases, run, page writer and tests.

=========== ======================================================================================
folder      page
=========== ======================================================================================
validation  docs/evidence/validation.md: published numbers and trends beside ours
santos2017  docs/evidence/santos2017.md: the runs of Santos (2017) again
contacts    docs/evidence/contacts.md: the contact laboratory
hard        docs/evidence/hard.md: situations in which codes of this kind break
random      docs/evidence/random.md: whatever a scene may say ends finite or with a sentence
step        docs/evidence/step.md: chosen time steps beside an explicit one of 0.1 us
light       docs/evidence/light.md: cages under light loads
structure   docs/evidence/structure.md: modes of an axlebox beside its finite elements
measured    docs/evidence/monitor_measured.md, run_to_failure.md, spall_width.md: the monitor on measured data
impact      docs/evidence/impact.md: what a sensor receives of a spall, beside published observations
damping     docs/evidence/damping.md: what the damping of the contacts changes
service     docs/evidence/sensors.md: what a sensor in service receives, and what the monitor says of it
heat        docs/evidence/heat.md: torque and steady temperatures beside published ones
ladder      docs/evidence/ladder.md: what accuracy costs
automatic   docs/evidence/automatic.md: what `effects: auto` chooses, on trial
trial       docs/evidence/trial.md, docs/monitor.md: the benchmark of monitors
population  docs/evidence/learner.md: what a learner makes of a set, how fast sets are made
fleet       docs/evidence/fleet_year.md: a year of 64 axleboxes in one store, and what it takes
follow      docs/evidence/estimator.md: the estimator judged, a train followed by its vibration
calibration docs/estimate.md: scenes fitted to recordings of hidden axleboxes
performance docs/performance.md: speeds measured by `benchmarks`
ros         the ROS graph with nodes killed, starved and fed nonsense; what each node costs
standard    shipped scenes with the standard effects
pages       pages from templates and numbers; where pages and pictures go, and how pictures are made small
tables      tables in Markdown
runner      results in files: what is there is not worked out again
stamps      which command and which code each picture is of
=========== ======================================================================================

``python -m evidence.NAME.page`` writes the page; its prose is the template ``page.md`` next to the module.
The numbers of `hard`, `random` and `step` are made before that, by ``python -m evidence.hard`` and so on.
None of this is installed with the package.
"""
