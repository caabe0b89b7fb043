"""What a type checker must accept; it is not run."""

from __future__ import annotations

from pathlib import Path
from typing import assert_type

import numpy as np

import lacuna

told = lacuna.diagnose(robot=Path("robot.toml"), reference=["a.csv", {"t": np.zeros(3)}], recordings="b.csv")
assert_type(told.causes[0].interval, tuple[float, float] | None)
assert_type(told.probabilities["payload"], float)
assert_type(told.traces[0].time, np.typing.NDArray[np.float64])
assert_type(lacuna.simulate("husky-drive", {"t": np.zeros(3)})["t"], np.typing.NDArray[np.float64])
assert_type(lacuna.Identifier(6, scheme="euler").step(0.0, 1.0, [0.5] * 6, 1e-3), float)
