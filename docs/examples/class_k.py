# class_k: envelope spectrum of a freight bearing (AAR class K) with a spalled cup and a spalled cone
import matplotlib.pyplot as plt
import numpy as np
from scipy.signal import butter, hilbert, sosfiltfilt

import beardyn_core as bd

faults = [{"on": "cup", "width_mm": 6, "length_mm": 20}, {"on": "cone", "width_mm": 6, "length_mm": 20}]
scene = bd.scene(bearing="AARK_6.5x9", load_kN=100, speed_rpm=580, faults=faults)
run = bd.simulate(scene, tier="quasistatic", duration=4.0)
band = butter(4, (500, 5000), "bandpass", fs=run.vibration.rate, output="sos")
envelope = np.abs(hilbert(sosfiltfilt(band, run.vibration.values[:, 2])))
hertz, spectrum = np.fft.rfftfreq(len(envelope), 1 / run.vibration.rate), np.abs(np.fft.rfft(envelope))
plt.plot(hertz[20:1600], spectrum[20:1600])
plt.savefig("class_k.png")
