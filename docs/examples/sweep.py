# %% [markdown]
# # A set of labelled runs, and a first learner on it
#
# Fifty runs of fifty bearings, healthy or with one spall. It takes a few minutes on two cores, and goes on
# where it was when it is stopped. `pip install 'beardyn[sweep]'`.

# %%
import matplotlib.pyplot as plt
import numpy as np

import beardyn_core as bd
from beardyn_core.population.learner import Learner

runs = bd.sweep("fifty", "my_set", runs=50, progress=True)
print(runs)

# %% [markdown]
# The table has a row a run: its part, its bearing, what was drawn, and every label. No bearing is in two
# parts.

# %%
runs.table[
    ["run", "split", "bearing_id", "condition", "defects[0].width_mm", "load_fz_N_mean", "speed_kmh_mean"]
]

# %% [markdown]
# Signals are read when they are asked for, as xarray.

# %%
spalled = int(runs.table["run"][runs.table["condition"] == "cup"].iloc[0])
runs.signals.vibration.sel(run=spalled, axis="z").isel(time_vibration=slice(0, 4000)).plot()

# %% [markdown]
# A learner of one's own takes shuffled batches, in bounded memory; here only their level is looked at.

# %%
for batch in runs.batches(8, part="train", labels=["condition"], seed=0):
    level = batch["vibration"].std(axis=(1, 2))
    plt.plot(batch["condition"], level, "o", color="tab:blue")

# %% [markdown]
# The baseline: random forests on what the monitor works out of each run, tested on bearings that it has not
# seen. A handful of them shows little: [sets of labelled runs](../sweep.md) has the answer of hundreds.

# %%
learner = Learner().fit(runs)
found = learner.judged("unseen bearings", runs)
print(f"{found.count} runs, {100 * found.accuracy:.0f} % named right")
for condition, named in found.matrix.items():
    print(condition, named)

# %%
shares = dict(list(learner.importance().items())[:8])
plt.figure()
plt.barh(np.array(list(shares))[::-1], np.array(list(shares.values()))[::-1])
