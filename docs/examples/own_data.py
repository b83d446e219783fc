# %% [markdown]
# # Vibration that was measured
#
# A file of vibration, the speed of the shaft and the geometry of the bearing are enough for the monitor. This
# one is written here by the twin, so that the notebook runs anywhere: put your own in its place. `pip install
# '.[data]'`.

# %%
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import beardyn_core as bd

twin = bd.simulate("cone_spall", tier="quasistatic", duration=4.0)
table = np.column_stack((twin.vibration.time, twin.vibration.values))
np.savetxt("vibration.csv", table, delimiter=",", header="time,ax,ay,az", comments="", fmt="%.7g")
speed = twin.truth["speed"]["rpm"]["mean"]
print(Path("vibration.csv").read_text(encoding="utf-8")[:120], f"...\nshaft: {speed:.0f} rpm")

# %% [markdown]
# ## In
#
# State what is not in the file: unit, speed, bearing. Anything that is missing, or that could be meant in
# two ways, is an error with a sentence.

# %%
run = bd.read_measured("vibration.csv", unit="m/s2", speed_rpm=speed, bearing="HS130x230")
print(run.vibration.values.shape, "samples at", run.vibration.rate, "Hz; truth:", dict(run.truth))
try:
    bd.read_measured("vibration.csv", speed_rpm=speed, bearing="HS130x230")
except bd.InputError as error:
    print("without a unit:", str(error)[:160])

# %% [markdown]
# ## Judged
#
# A speed that is typed in is a mean: where a train slows down, lines smear, and the angle of the shaft, from
# a tachometer or a second column, keeps them sharp. This one goes at one speed, so both say the same.

# %%
for what, each in (("mean speed", run), ("shaft angle", twin)):
    conclusion = bd.monitor(each)
    print(f"{what}: {conclusion.verdict} in {conclusion.agreeing} of {conclusion.analyses} analyses")
    print("   ", conclusion.finding.reason)

# %% [markdown]
# ## How wide
#
# What a monitor has found is measured as well, by the time between a roller's entry into the spall and its
# exit.

# %%
measured = bd.severity(twin)
print(measured)
print("the truth:", f"{twin.labels['fault_width_m'] * 1e3:.0f} mm")

# %%
plt.figure(figsize=(7, 2.4))
plt.specgram(run.vibration.values[:, 2], NFFT=1024, Fs=run.vibration.rate, noverlap=512, cmap="Greys")
plt.xlabel("time, s")
plt.ylabel("frequency, Hz")
plt.show()

# %% [markdown]
# Formats, options, several bearings on a shaft, records of months: [Measured files](../measured.md).
