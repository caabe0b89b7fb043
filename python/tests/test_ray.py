"""Diagnoses on a local Ray cluster of two workers, of which one is killed."""

from __future__ import annotations

import json
import os
import signal
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import drawn
import pytest

import lacuna

ray = pytest.importorskip("ray")

COUNT = 4


@pytest.fixture(scope="module")
def cluster() -> Iterator[None]:
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
    yield
    ray.shutdown()


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """A robot, references, and recordings with a load; between them one that is no recording."""
    root = tmp_path_factory.mktemp("fleet")
    (root / "robot.json").write_text(json.dumps(drawn.robot()))
    reference = [drawn.write(drawn.drive(drawn.robot(), seed, f"ref_{seed}"), root / "reference") for seed in (1, 2)]
    loaded = drawn.robot(payload={"mass": drawn.PAYLOAD})
    rows = []
    for seed in range(COUNT):
        path = drawn.write(drawn.drive(loaded, 40 + seed, f"run_{seed}"), root / "runs")
        rows.append({"id": f"unit-{seed}", "recording": path, "robot_id": f"robot-{seed % 2}"})
    (root / "runs" / "broken.csv").write_text("time_s,torque_left_Nm\n0.0,abc\n")
    rows.insert(1, {"id": "broken", "recording": root / "runs" / "broken.csv"})
    return {"rows": rows, "robot": root / "robot.json", "reference": reference}


@pytest.fixture(scope="module")
def told(cluster: None, files: dict[str, Any]) -> list[dict[str, Any]]:
    from lacuna.ray import diagnose

    return diagnose(files["rows"], robot=files["robot"], reference=files["reference"], concurrency=2).take_all()


def test_every_recording_has_a_row(told: list[dict[str, Any]], files: dict[str, Any]) -> None:
    assert [row["id"] for row in told] == ["unit-0", "broken", "unit-1", "unit-2", "unit-3"]
    for row in told:
        if row["id"] == "broken":
            assert row["outcome"] == "failed" and "broken.csv" in row["error"] and row["verdict"] is None
            continue
        assert (row["outcome"], row["error"], row["verdict"]) == ("done", None, "explained")
        first = row["causes"][0]
        assert first["effect"] == "payload" and first["low"] < first["magnitude"] < first["high"]
        assert {p["effect"]: p["probability"] for p in row["probabilities"]}["payload"] == first["probability"]
    # A worker says what is said here.
    here = lacuna.diagnose(robot=files["robot"], reference=files["reference"], recordings=files["rows"][0]["recording"])
    assert told[0]["json"] == here.to_json() and told[0]["robot_id"] == "robot-0"


def test_a_killed_worker_loses_nothing(told: list[dict[str, Any]], files: dict[str, Any], tmp_path: Path) -> None:
    from lacuna.ray import _dataset, _diagnosis, _rows

    marker, victim = tmp_path / "pid", "unit-1"

    def work(row: dict[str, Any]) -> lacuna.Diagnosis:
        def progress(stage: str) -> None:
            # In the middle of the first attempt: say who this is, and wait for the end.
            if row["id"] == victim and stage == "screening every effect" and not marker.exists():
                marker.with_suffix(".new").write_text(str(os.getpid()))
                marker.with_suffix(".new").rename(marker)
                time.sleep(120)

        return _diagnosis(row, reading="normal", progress=progress)

    killed: list[int] = []

    def kill() -> None:
        while not marker.exists():
            time.sleep(0.05)
        killed.append(int(marker.read_text()))
        os.kill(killed[0], signal.SIGKILL)

    killer = threading.Thread(target=kill, daemon=True)
    killer.start()
    usual = {"robot": str(files["robot"]), "reference": ";".join(map(str, files["reference"]))}
    rows = _dataset(_rows(files["rows"], usual), work, concurrency=2, num_cpus=1.0, max_retries=3).take_all()
    killer.join(timeout=10)
    assert len(killed) == 1 and killed[0] != os.getpid()
    assert rows == told


def test_wrong_rows_are_refused_before_any_work() -> None:
    from lacuna.ray import diagnose

    for rows, message in (
        (["a.csv", "a.csv"], "is there already"),
        ([{"recordng": "a.csv"}], "no key is called 'recordng'"),
        ([{"id": "a"}], "no recording"),
    ):
        with pytest.raises(lacuna.LacunaError, match=message):
            diagnose(rows, robot="husky-drive")
