"""Diagnoses on a Ray cluster: recordings go in, a dataset with one row for each comes out.

Needs the extra ``lacuna[ray]``. Workers open the files themselves: paths must mean the same on every node.
"""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Callable, Iterable, Mapping
from functools import partial
from typing import Any

import pyarrow as pa
import ray.data

import lacuna

__all__ = ["SCHEMA", "diagnose"]

#: Columns of the result. ``outcome`` is ``done`` or ``failed``; what follows ``error`` is null where it failed.
SCHEMA = pa.schema(
    [
        ("id", pa.string()),
        ("recording", pa.string()),
        ("robot_id", pa.string()),
        ("robot", pa.string()),
        ("outcome", pa.string()),
        ("error", pa.string()),
        ("verdict", pa.string()),
        ("probability", pa.float64()),
        (
            "causes",
            pa.list_(
                pa.struct(
                    [
                        ("effect", pa.string()),
                        ("side", pa.string()),
                        ("probability", pa.float64()),
                        ("magnitude", pa.float64()),
                        ("low", pa.float64()),
                        ("high", pa.float64()),
                        ("unit", pa.string()),
                    ]
                )
            ),
        ),
        ("probabilities", pa.list_(pa.struct([("effect", pa.string()), ("probability", pa.float64())]))),
        ("limits", pa.list_(pa.string())),
        ("lost", pa.list_(pa.string())),
        ("json", pa.string()),
    ]
)

#: Keys that a row may have.
_KEYS = ("id", "recording", "robot_id", "robot", "reference", "mapping")
#: Most causes of a row.
_CAUSES = 3
#: More blocks than this cost more than they save: a block is what a retry does again.
_BLOCKS = 1000

_Path = str | os.PathLike[str]
_Row = Mapping[str, Any]
_Work = Callable[[dict[str, Any]], lacuna.Diagnosis]


def diagnose(
    paths_or_rows: Iterable[_Path | _Row],
    *,
    robot: _Path | None = None,
    reference: _Path | Iterable[_Path] = (),
    mapping: _Path | None = None,
    reading: str = "normal",
    concurrency: int | None = None,
    num_cpus: float = 1.0,
    max_retries: int = 3,
) -> ray.data.Dataset:
    """Diagnoses each recording by itself, on the workers of a Ray cluster.

    A recording that cannot be diagnosed becomes a row with ``outcome`` ``failed`` and the sentence that says why. A task whose
    worker dies is done again, up to ``max_retries`` times, and gives the same row: answers depend on the input only. Nothing
    is computed before the dataset is read; to read it twice without computing twice, ``materialize`` it.

    Parameters
    ----------
    paths_or_rows
        Recordings: paths, or dicts with ``recording`` (a path, or several joined by ``;`` for a run in several files) and
        perhaps ``id`` (else the path), ``robot_id``, and ``robot``, ``reference`` (joined by ``;``) and ``mapping`` of their
        own. Ids are told once.
    robot, reference, mapping, reading
        As in ``lacuna.diagnose``, for rows that do not say it themselves. By path or name.
    concurrency
        Most tasks at a time; without it, as many as the cluster has room for.
    num_cpus
        Cores of a task, which uses as many threads.
    max_retries
        How often a task is done again when its worker dies; after that, reading the dataset raises what Ray says.

    Returns
    -------
    ray.data.Dataset
        Rows in the order of the input, with the columns of ``SCHEMA``.

    Raises
    ------
    lacuna.LacunaError
        When an id is given twice, or a row has an unknown key or no recording.
    """
    usual = {
        "robot": None if robot is None else os.fspath(robot),
        "reference": _joined(reference),
        "mapping": None if mapping is None else os.fspath(mapping),
    }
    work = partial(_diagnosis, reading=reading)
    return _dataset(_rows(paths_or_rows, usual), work, concurrency=concurrency, num_cpus=num_cpus, max_retries=max_retries)


def _dataset(
    rows: list[dict[str, Any]], work: _Work, *, concurrency: int | None, num_cpus: float, max_retries: int
) -> ray.data.Dataset:
    # As text, so that rows with and without a key are of one type.
    items = [{"row": json.dumps(row)} for row in rows]
    dataset = ray.data.from_items(items, override_num_blocks=max(1, min(len(items), _BLOCKS)))
    dataset.context.execution_options.preserve_order = True
    with warnings.catch_warnings():
        # Without `max_retries` a recording that always kills its worker would be tried for ever; the extra names the
        # versions of Ray that take it here.
        warnings.filterwarnings("ignore", message=".*ray_remote_args.*")
        return dataset.map_batches(
            partial(_batch, work=work, threads=max(1, int(num_cpus))),
            batch_size=1,
            batch_format="pyarrow",
            concurrency=concurrency,
            num_cpus=num_cpus,
            max_retries=max_retries,
        )


def _joined(paths: _Path | Iterable[_Path]) -> str:
    if isinstance(paths, str | os.PathLike):
        return os.fspath(paths)
    return ";".join(os.fspath(path) for path in paths)


def _rows(paths_or_rows: Iterable[_Path | _Row], usual: dict[str, Any]) -> list[dict[str, Any]]:
    """Whole rows, with ids that are told once."""
    out: list[dict[str, Any]] = []
    ids: set[str] = set()
    for given in paths_or_rows:
        row = {"recording": os.fspath(given)} if isinstance(given, str | os.PathLike) else dict(given)
        unknown = [key for key in row if key not in _KEYS]
        if unknown:
            raise lacuna.LacunaError(f"row {len(out) + 1}: no key is called '{unknown[0]}'; known are {', '.join(_KEYS)}")
        if not row.get("recording"):
            raise lacuna.LacunaError(f"row {len(out) + 1}: no recording; give its path under 'recording'")
        for key in ("recording", "reference"):
            if row.get(key) is not None:
                row[key] = _joined(row[key])
        whole = {key: row.get(key) if row.get(key) is not None else usual.get(key) for key in _KEYS}
        whole = {key: None if value is None else str(value) for key, value in whole.items()}
        whole["id"] = whole["id"] or whole["recording"]
        if whole["id"] in ids:
            raise lacuna.LacunaError(f"row {len(out) + 1}: the id '{whole['id']}' is there already; give each once")
        ids.add(str(whole["id"]))
        out.append(whole)
    return out


def _batch(batch: pa.Table, *, work: _Work, threads: int) -> pa.Table:
    # Before the first diagnosis of this process, which makes its pool of threads.
    os.environ.setdefault("RAYON_NUM_THREADS", str(threads))
    rows = [_told(json.loads(text), work) for text in batch["row"].to_pylist()]
    return pa.Table.from_pylist(rows, schema=SCHEMA)


def _diagnosis(row: dict[str, Any], *, reading: str, progress: Callable[[str], object] | None = None) -> lacuna.Diagnosis:
    def paths(joined: str | None) -> list[str]:
        return [path for path in (joined or "").split(";") if path]

    return lacuna.diagnose(
        robot=row["robot"],
        reference=paths(row["reference"]),
        recordings=paths(row["recording"]),
        mapping=row["mapping"],
        reading=reading,  # type: ignore[arg-type]
        progress=progress,
    )


def _told(row: dict[str, Any], work: _Work) -> dict[str, Any]:
    """The row of a recording, whatever became of it."""
    out = {key: row[key] for key in ("id", "recording", "robot_id", "robot")}
    try:
        diagnosis = work(row)
    except lacuna.LacunaError as error:
        return out | {"outcome": "failed", "error": str(error)}
    probabilities = [{"effect": effect, "probability": p} for effect, p in diagnosis.probabilities.items()]
    return out | {
        "outcome": "done",
        "verdict": diagnosis.verdict,
        "probability": probabilities[0]["probability"] if probabilities else None,
        "causes": [_cause(cause) for cause in diagnosis.causes[:_CAUSES]],
        "probabilities": probabilities,
        "limits": diagnosis.limits,
        "lost": diagnosis.lost,
        "json": diagnosis.to_json(),
    }


def _cause(cause: lacuna.Cause) -> dict[str, Any]:
    low, high = cause.interval or (None, None)
    return {
        "effect": cause.effect,
        "side": cause.side,
        "probability": cause.probability,
        "magnitude": cause.magnitude,
        "low": low,
        "high": high,
        "unit": cause.unit,
    }
