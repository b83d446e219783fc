# data_set: fifty labelled runs, their signals in files and their labels in one table
import random

import pandas as pd

import beardyn_core as bd

RUNS, SECONDS, rows = 50, 2.0, []
for number in range(RUNS):
    fault = {"on": random.choice(["cup", "cone", "roller"]), "width_mm": random.uniform(1, 8)}
    change = {"seed": number, "speed_kmh": random.uniform(80, 200), "faults": [fault][: number % 4]}
    run = bd.simulate("cup_spall", tier="quasistatic", duration=SECONDS, **change)
    run.to_npz(f"run_{number:02}.npz", ["vibration", "shaft"])
    rows.append({"rms": run.vibration.values[:, 2].std(), **run.labels})
pd.DataFrame(rows).to_csv("labels.csv", index=False)
