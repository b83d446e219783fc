# wheel_flat: loads of the rollers while a wheel with a flat rolls, between the strikes and at the strikes
import matplotlib.pyplot as plt
import numpy as np

import beardyn_core as bd

run = bd.simulate("wheel_flat", tier="quasistatic", duration=2.0)
loads = run.contacts.largest[..., run.contacts.of("cup")]  # of each 5 ms, [snapshot, row, roller]
most = loads.max(axis=(1, 2))[run.contacts.time > 0.25]
usual, strike = np.median(most), most.max()
print(f"most loaded roller: {usual / 1e3:.1f} kN, at the strikes {strike / 1e3:.1f} kN")
plt.plot(run.contacts.time[run.contacts.time > 0.25], most / 1e3)
plt.xlabel("time, s")
plt.ylabel("largest roller load of each 5 ms, kN")
plt.savefig("wheel_flat.png")
