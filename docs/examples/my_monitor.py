# my_monitor.py: the reference chain with a band selection of one's own
import numpy as np

from beardyn_core.monitor.chain import Band, Chain


def loudest_band(stretch, settings):
    """Two kilohertz around the loudest frequency of the vertical axis, from 2 kHz upwards."""
    power = np.abs(np.fft.rfft(stretch.acceleration[:, 2])) ** 2
    frequency = np.fft.rfftfreq(len(stretch.acceleration), 1.0 / stretch.rate)
    smooth = np.convolve(power, np.ones(500), mode="same") * (frequency > 2000.0)
    middle = min(frequency[smooth.argmax()], stretch.rate / 2.0 - 1000.0)
    return Band(middle - 1000.0, middle + 1000.0)


chain = Chain(select_band=loudest_band)  # also: whiten, envelope, track, score, decide
