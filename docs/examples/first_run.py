# %% [markdown]
# # A spalled bearing, simulated and judged
#
# An axlebox bearing with a spall on its cup, the outer ring, under a train that slows down from 200 km/h:
# simulated, looked at, and given to a monitor that does not know of the spall. `pip install '.[data]'` in a
# clone of the repository; the first run compiles its kernels, half a minute.

# %%
import matplotlib.pyplot as plt
import numpy as np
from scipy.signal import butter, hilbert, sosfiltfilt

import beardyn_core as bd

run = bd.simulate("cup_spall", tier="quasistatic", duration=4.0)
print(run)

# %% [markdown]
# ## What each roller carries
#
# `run.contacts.load` has the load of every roller on every surface, `run.rollers.angle` where it is. The
# first row has the spall; one roller through six turns of the shaft shows the load zone, and the notch where
# the spall lets it go.

# %%
load = run.contacts.load[:, 0, 3, run.contacts.of("cup")] / 1e3
few = run.contacts.time < 0.3
plt.figure(figsize=(7, 2.4))
plt.plot(run.contacts.time[few], load[few])
plt.xlabel("time, s")
plt.ylabel("roller 3 on the cup, kN")
plt.show()

# %% [markdown]
# ## What the box shakes with
#
# An accelerometer on top of the axlebox measures the strikes among the shaking that the wheel brings from the
# track.

# %%
vertical, rate = run.vibration.values[:, 2], run.vibration.rate
shown = slice(round(1.0 * rate), round(1.1 * rate))
plt.figure(figsize=(7, 2.4))
plt.plot(run.vibration.time[shown], vertical[shown], linewidth=0.6)
plt.xlabel("time, s")
plt.ylabel("vertical, m/s²")
plt.show()

# %% [markdown]
# ## Its envelope spectrum
#
# A band in which the box rings, its envelope, and the spectrum of that over orders of the shaft: the lines
# stand where the geometry of the bearing puts a fault of the cup (BPFO).

# %%
band = butter(4, (2000, 8000), "bandpass", fs=rate, output="sos")
envelope = np.abs(hilbert(sosfiltfilt(band, vertical)))
turns = np.interp(run.vibration.time, run.shaft.time, run.shaft.angle) / (2 * np.pi)
even = np.linspace(turns[0], turns[-1], len(turns))
lines = np.abs(np.fft.rfft(np.hanning(len(even)) * (np.interp(even, turns, envelope) - envelope.mean())))
orders = np.fft.rfftfreq(len(even), even[1] - even[0])
some = (orders > 1) & (orders < 25)
plt.figure(figsize=(7, 2.6))
plt.plot(orders[some], lines[some] / lines[some].max(), linewidth=0.8)
for multiple in (1, 2, 3):
    order = multiple * run.truth["fault_frequencies_per_rev"]["BPFO"]
    plt.axvline(order, color="tab:red", linestyle=":", linewidth=1)
plt.xlabel("orders of the shaft; dotted: BPFO and its multiples")
plt.ylabel("envelope, 1 = largest")
plt.show()

# %% [markdown]
# ## The verdict of the monitor
#
# It gets vibration, shaft angle and load, and the data of the bearing. `run.truth` has what it cannot
# know.

# %%
conclusion = bd.monitor(run)
print(conclusion.verdict, f"in {conclusion.agreeing} of {conclusion.analyses} analyses")
print(conclusion.finding.reason)
print("the truth:", run.truth["condition"], "-", f"{run.labels['fault_width_m'] * 1e3:.0f} mm wide")

# %% [markdown]
# Next: [a bearing of your own](../tutorial/own_bearing.md), or the [reference of the arrays](../python.md).
