"""Sweeps: draws, plans, sets, workers that die."""
