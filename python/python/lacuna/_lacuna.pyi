from collections.abc import Callable, Iterable
from os import PathLike
from typing import Any, Literal, TypeAlias, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

_Path: TypeAlias = str | PathLike[str]
_Floats: TypeAlias = NDArray[np.float64]
# A recording: "t" (s) or "t_ns", signals by id or column name, perhaps "name".
_Arrays: TypeAlias = dict[str, Any]
_Drives: TypeAlias = _Path | _Arrays | Iterable[_Path | _Arrays]
_Reading: TypeAlias = Literal["normal", "strict", "tolerant"]
_Verdict: TypeAlias = Literal["explained", "unknown", "no_mismatch", "withheld"]
_Side: TypeAlias = Literal["left", "right"]

__all__ = [
    "Cause",
    "check",
    "diagnose",
    "Diagnosis",
    "LacunaError",
    "Followed",
    "Identifier",
    "SigmoidLayer",
    "simulate",
    "Trace",
    "TracedSignal",
    "effects",
    "__version__",
]

__version__: str

class LacunaError(ValueError): ...

def check(
    paths: _Path | Iterable[_Path],
    *,
    mapping: _Path | None = None,
    reading: _Reading = "normal",
    robot: _Path | None = None,
) -> dict[str, Any]: ...
def diagnose(
    case: _Path | None = None,
    *,
    robot: _Path | dict[str, Any] | None = None,
    reference: _Drives | None = None,
    recordings: _Drives | None = None,
    heldout: _Drives | None = None,
    mapping: _Path | None = None,
    reading: _Reading = "normal",
    same_robot: bool = False,
    visit: list[str] | None = None,
    effects: _Path | Iterable[_Path] | None = None,
    adopt: _Path | Iterable[_Path] | None = None,
    next: bool = False,
    progress: Callable[[str], object] | None = None,
) -> Diagnosis: ...
def effects() -> list[dict[str, Any]]: ...
def simulate(
    robot: _Path | dict[str, Any],
    inputs: _Path | _Arrays,
    *,
    mapping: _Path | None = None,
    effects: _Path | Iterable[_Path] | None = None,
) -> dict[str, _Floats]: ...

@final
class Diagnosis:
    @property
    def verdict(self) -> _Verdict: ...
    @property
    def causes(self) -> list[Cause]: ...
    @property
    def probabilities(self) -> dict[str, float]: ...
    @property
    def sentences(self) -> list[str]: ...
    @property
    def limits(self) -> list[str]: ...
    @property
    def lost(self) -> list[str]: ...
    @property
    def text(self) -> str: ...
    @property
    def traces(self) -> list[Trace]: ...
    @property
    def predictions(self) -> list[dict[str, Any]]: ...
    def to_dict(self) -> dict[str, Any]: ...
    def to_json(self) -> str: ...
    @classmethod
    def from_json(cls, text: str, /) -> Diagnosis: ...
    def save_report(self, path: _Path) -> None: ...
    def _repr_html_(self) -> str: ...

@final
class Cause:
    @property
    def effect(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def side(self) -> _Side | None: ...
    @property
    def probability(self) -> float: ...
    @property
    def magnitude(self) -> float | None: ...
    @property
    def sigma(self) -> float | None: ...
    @property
    def interval(self) -> tuple[float, float] | None: ...
    @property
    def unit(self) -> str: ...
    @property
    def where(self) -> tuple[float, float, float] | None: ...
    @property
    def when(self) -> dict[str, list[tuple[float, float]]] | None: ...
    @property
    def parameters(self) -> dict[str, tuple[float, float | None, bool]]: ...

@final
class Trace:
    @property
    def recording(self) -> str: ...
    @property
    def left_out(self) -> bool: ...
    @property
    def time(self) -> _Floats: ...
    @property
    def restarts(self) -> list[int]: ...
    @property
    def path(self) -> _Floats: ...
    @property
    def before(self) -> _Floats: ...
    @property
    def after(self) -> _Floats: ...
    @property
    def signals(self) -> list[TracedSignal]: ...

@final
class TracedSignal:
    @property
    def signal(self) -> str: ...
    @property
    def unit(self) -> str: ...
    @property
    def side(self) -> _Side | None: ...
    @property
    def recorded(self) -> _Floats: ...
    @property
    def nominal(self) -> _Floats: ...
    @property
    def retuned(self) -> _Floats: ...
    @property
    def corrected(self) -> _Floats: ...
    @property
    def usual(self) -> float | None: ...

@final
class Identifier:
    def __new__(
        cls,
        units: int,
        *,
        pole: float = 8.0,
        gain: float = 500.0,
        scheme: Literal["midpoint", "exponential", "euler"] = "midpoint",
        dead_zone: float = 0.0,
        start: float = 0.0,
    ) -> Identifier: ...
    @property
    def units(self) -> int: ...
    @property
    def estimate(self) -> float: ...
    @property
    def weights(self) -> _Floats: ...
    def step(self, x_k: float, x_k1: float, phi: ArrayLike, h: float) -> float: ...
    def follow(self, x: ArrayLike, phi: ArrayLike, h: float | ArrayLike, *, comparison: ArrayLike | None = None) -> Followed: ...

@final
class Followed:
    @property
    def estimates(self) -> _Floats: ...
    @property
    def errors(self) -> _Floats: ...
    @property
    def weights(self) -> _Floats: ...
    @property
    def certificate(self) -> dict[str, Any] | None: ...

@final
class SigmoidLayer:
    def __new__(
        cls,
        threshold: ArrayLike,
        weight: ArrayLike,
        scale: ArrayLike,
        activation: Literal["logistic", "tanh"] = "logistic",
    ) -> SigmoidLayer: ...
    @property
    def units(self) -> int: ...
    @property
    def inputs(self) -> int: ...
    def regressor(self, inputs: ArrayLike, /) -> _Floats: ...
