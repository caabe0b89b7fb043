"""From drives to a verdict."""

from __future__ import annotations

import json
import pickle
import signal
import threading
from pathlib import Path
from typing import Any

import drawn
import numpy as np
import pytest

import lacuna


def test_the_hidden_load_is_named(diagnosis: lacuna.Diagnosis) -> None:
    assert diagnosis.verdict == "explained"
    first = diagnosis.causes[0]
    assert first.effect == "payload" and first.unit == "kg" and first.side is None and first.when is None
    assert first.probability > 0.5 and diagnosis.probabilities["payload"] == first.probability
    assert first.magnitude is not None and abs(first.magnitude - drawn.PAYLOAD) < 1.0
    assert first.interval is not None and first.interval[0] < first.magnitude < first.interval[1]
    assert first.sigma is not None and np.isclose(first.interval[1] - first.magnitude, 1.645 * first.sigma)
    assert first.parameters["mass"][0] == first.magnitude
    assert {"none", "unknown"}.isdisjoint(cause.effect for cause in diagnosis.causes)
    assert "unknown" in diagnosis.probabilities
    assert "extra mass" in diagnosis.sentences[0] and first.name == "extra mass"
    assert "explained: payload" in repr(diagnosis) and "payload" in repr(first)


def test_nothing_is_named_where_nothing_is_hidden(references: list[dict[str, Any]]) -> None:
    plain = [drawn.drive(drawn.robot(), seed, f"run_{seed}") for seed in (21, 22)]
    told = lacuna.diagnose(robot=drawn.robot(), reference=references, recordings=plain)
    assert told.verdict == "no_mismatch"
    assert max(told.probabilities, key=lambda effect: told.probabilities[effect]) == "none"


def test_files_and_arrays_give_the_same_answer(
    diagnosis: lacuna.Diagnosis, references: list[dict[str, Any]], recordings: list[dict[str, Any]], tmp_path: Path
) -> None:
    for part, drives in (("reference", references), ("recordings", recordings)):
        for recording in drives:
            drawn.write(recording, tmp_path / "case" / part)
    (tmp_path / "case" / "robot.json").write_text(json.dumps(drawn.robot()))
    told = lacuna.diagnose(tmp_path / "case")
    assert told.to_dict()["diagnosis"] == diagnosis.to_dict()["diagnosis"]
    assert len(told.to_dict()["sources"]["reference"]) == len(references)
    one_by_one = lacuna.diagnose(
        robot=tmp_path / "case" / "robot.json",
        reference=str(tmp_path / "case" / "reference"),
        recordings=[tmp_path / "case" / "recordings" / "run_11.csv", recordings[1]],
    )
    assert one_by_one.to_dict()["diagnosis"] == diagnosis.to_dict()["diagnosis"]


def test_it_is_written_and_read_back(diagnosis: lacuna.Diagnosis, tmp_path: Path) -> None:
    again = lacuna.Diagnosis.from_json(diagnosis.to_json())
    assert again.to_json() == diagnosis.to_json() == pickle.loads(pickle.dumps(diagnosis)).to_json()
    assert again.to_dict() == json.loads(diagnosis.to_json())
    assert again.text == diagnosis.text
    page = tmp_path / "page.html"
    again.save_report(page)
    assert "extra mass" in page.read_text() and page.read_text().lstrip().lower().startswith("<!doctype html")
    with pytest.raises(lacuna.LacunaError, match="cannot write"):
        again.save_report(tmp_path / "missing" / "page.html")
    with pytest.raises(lacuna.LacunaError, match="not what `lacuna diagnose --json`"):
        lacuna.Diagnosis.from_json("{}")


def test_the_text_is_that_of_the_command(diagnosis: lacuna.Diagnosis) -> None:
    assert diagnosis.text == str(diagnosis)
    assert diagnosis.text.startswith(diagnosis.sentences[0]) and "\nCauses\n" in diagnosis.text
    assert "\x1b" not in diagnosis.text


def test_names_stay_text_in_notebooks(diagnosis: lacuna.Diagnosis) -> None:
    told = diagnosis.to_dict()
    told["diagnosis"]["ranked"][0]["name"] = "<script>alert(1)</script> & more"
    html = lacuna.Diagnosis.from_json(json.dumps(told))._repr_html_()
    assert "<table>" in html and "<script" not in html and "&lt;script&gt;alert(1)&lt;/script&gt; &amp; more" in html


def test_traces_are_arrays(diagnosis: lacuna.Diagnosis, recordings: list[dict[str, Any]]) -> None:
    assert sorted({trace.recording for trace in diagnosis.traces}) == sorted(r["name"] for r in recordings)
    trace = diagnosis.traces[0]
    n = trace.time.size
    assert trace.time.dtype == np.float64 and n > 50 and np.all(np.diff(trace.time) > 0)
    assert trace.path.shape == (n, 2) and trace.before.shape == trace.after.shape == (n,)
    # The corrected simulation is nearer to what was recorded.
    speed = next(signal for signal in trace.signals if "speed" in signal.signal)
    error = [np.nanmean((speed.recorded - model) ** 2) for model in (speed.nominal, speed.corrected)]
    assert error[1] < error[0]
    raw = diagnosis.to_dict()["diagnosis"]["traces"][0]
    assert np.array_equal(trace.time, raw["time"])


def test_held_out_drives_are_predicted(references: list[dict[str, Any]], recordings: list[dict[str, Any]]) -> None:
    model = drawn.robot(payload={"mass": drawn.PAYLOAD})
    truth = lacuna.simulate(model, drawn.torques(31))
    # The state at the start and the inputs: what a prediction is given.
    held = {column: values.copy() for column, values in truth.items()}
    for column in set(held) - {"t", "torque_left_Nm", "torque_right_Nm"}:
        held[column][1:] = np.nan
    told = lacuna.diagnose(robot=drawn.robot(), reference=references, recordings=recordings, heldout=held)
    (predicted,) = told.predictions
    assert predicted["name"] == "heldout_1" and predicted["t"].size == held["t"].size
    speed = np.column_stack([truth["wheel_speed_left_rad_s"], truth["wheel_speed_right_rad_s"]])
    error = {how: np.mean((predicted[how]["wheel_speed"] - speed) ** 2) for how in ("corrected", "nominal")}
    assert error["corrected"] < error["nominal"]
    assert pickle.loads(pickle.dumps(told)).predictions == []


def test_stages_are_told_and_others_run_meanwhile(
    references: list[dict[str, Any]], recordings: list[dict[str, Any]]
) -> None:
    stages: list[str] = []
    counted, done = [0], threading.Event()

    def count() -> None:
        while not done.is_set():
            counted[0] += 1

    other = threading.Thread(target=count)

    def progress(stage: str) -> None:
        stages.append(stage)
        if len(stages) == 2:
            other.start()

    lacuna.diagnose(robot=drawn.robot(), reference=references, recordings=recordings, progress=progress)
    done.set()
    other.join()
    assert stages[0] == "reading the recordings" and len(stages) >= 5 and counted[0] > 1000


@pytest.mark.parametrize("stop", [KeyboardInterrupt, ZeroDivisionError])
def test_what_the_listener_raises_ends_the_work(
    references: list[dict[str, Any]], recordings: list[dict[str, Any]], stop: type[BaseException]
) -> None:
    def progress(stage: str) -> None:
        if stage == "screening every effect":
            raise stop("enough")

    with pytest.raises(stop, match="enough"):
        lacuna.diagnose(robot=drawn.robot(), reference=references, recordings=recordings, progress=progress)


def test_an_interrupt_ends_the_work_at_the_next_stage(
    references: list[dict[str, Any]], recordings: list[dict[str, Any]]
) -> None:
    stages: list[str] = []

    def progress(stage: str) -> None:
        stages.append(stage)
        if len(stages) == 2:
            # As control-C while the next stage is computed: nothing of Python runs until it ends.
            threading.Timer(0.05, signal.raise_signal, [signal.SIGINT]).start()

    # What runs in the background of a shell begins with interrupts ignored.
    usual = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with pytest.raises(KeyboardInterrupt):
            lacuna.diagnose(robot=drawn.robot(), reference=references, recordings=recordings, progress=progress)
    finally:
        signal.signal(signal.SIGINT, usual)
    assert 2 <= len(stages) < 6


def test_what_is_missing_is_said(references: list[dict[str, Any]], recordings: list[dict[str, Any]], tmp_path: Path) -> None:
    robot = drawn.robot()

    def refused(match: str, **arguments: Any) -> None:
        with pytest.raises(lacuna.LacunaError, match=match):
            lacuna.diagnose(**arguments)

    refused("no robot was named", recordings=recordings)
    refused("give drives in which its simulation was right", robot=robot, recordings=recordings)
    refused("nothing to diagnose", robot=robot, reference=references)
    refused("either it, or a robot", case=tmp_path, recordings=recordings)
    refused("there is no case folder", case=tmp_path / "nowhere")
    refused("no file or folder", robot=robot, reference=references, recordings=tmp_path / "x.csv")
    refused("two recordings are called 'run_11'", robot=robot, reference=references, recordings=[recordings[0]] * 2)
    refused("same recording", robot=robot, reference=references, recordings=references[:1])
    refused("'strict', 'normal' or 'tolerant'", robot=robot, recordings=recordings, reading="lax")
    refused("there is no robot file", robot="robot.toml", reference=references, recordings=recordings)
    refused("torque", robot=robot, reference=references, recordings={"t": [0.0, 1.0], "gyro_z": [0.0, 0.0]})
    misspelt = drawn.robot(paylod={"mass": 1.0})
    refused("payload", robot=misspelt, reference=references, recordings=recordings)
    with pytest.raises(TypeError):
        lacuna.diagnose(robot=robot, reference=references, recordings=[5])  # type: ignore[list-item]
