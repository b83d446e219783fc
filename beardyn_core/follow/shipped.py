"""Estimators that are shipped."""

from __future__ import annotations

from pathlib import Path

from beardyn_core.base.config_folder import config_folder
from beardyn_core.follow.estimator import Estimator, read_estimator


def list_shipped() -> list[Path]:
    """List the files of the shipped estimators."""
    return sorted((config_folder() / "estimators").glob("*.npz"))


def shipped_estimators() -> list[Estimator]:
    """Read the shipped estimators."""
    return [read_estimator(path) for path in list_shipped()]
