"""Drives and diagnoses that several tests look at."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import pytest

sys.path.insert(0, str(Path(__file__).parent))

import drawn  # noqa: E402

import lacuna  # noqa: E402


@pytest.fixture(scope="session")
def references() -> list[dict[str, Any]]:
    """Drives of the robot as its simulation has it."""
    return [drawn.drive(drawn.robot(), seed, f"ref_{seed}") for seed in (1, 2, 3)]


@pytest.fixture(scope="session")
def recordings() -> list[dict[str, Any]]:
    """Drives with a load that the simulation does not know."""
    loaded = drawn.robot(payload={"mass": drawn.PAYLOAD})
    return [drawn.drive(loaded, seed, f"run_{seed}") for seed in (11, 12)]


@pytest.fixture(scope="session")
def diagnosis(references: list[dict[str, Any]], recordings: list[dict[str, Any]]) -> lacuna.Diagnosis:
    """The diagnosis of these."""
    return lacuna.diagnose(robot=drawn.robot(), reference=references, recordings=recordings)
