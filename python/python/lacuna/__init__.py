"""Lacuna compares recordings of a skid-steer robot with its simulation and says which physics was left out.

Everything is in SI: x forward, y left, z up. Arrays are numpy's.
"""

from ._lacuna import (
    Cause,
    Diagnosis,
    Followed,
    Identifier,
    LacunaError,
    SigmoidLayer,
    Trace,
    TracedSignal,
    __version__,
    check,
    diagnose,
    effects,
    simulate,
)

__all__ = [
    "Cause",
    "Diagnosis",
    "Followed",
    "Identifier",
    "LacunaError",
    "SigmoidLayer",
    "Trace",
    "TracedSignal",
    "__version__",
    "check",
    "diagnose",
    "effects",
    "simulate",
]
