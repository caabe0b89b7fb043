"""The examples of the documentation do what the page shows."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

PYTHON = Path(__file__).resolve().parents[1]
#: The page, and the package's README.
PAGES = [PYTHON.parent / "docs" / "python.md", PYTHON / "README.md"]
BLOCK = re.compile(r"^```(\S*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_every_example_runs_and_prints_what_is_shown(
    page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {"__name__": "example"}
    printed, compared = "", 0
    for language, text in BLOCK.findall(page.read_text()):
        if language == "python":
            assert printed == "", "what is printed is shown"
            exec(compile(text, page.name, "exec"), names)
            printed = capsys.readouterr().out
        elif language == "text,above":
            shown, lines = text.splitlines(), iter(printed.splitlines())
            for line in shown:
                assert line == "..." or line in lines, f"{line!r} is not printed:\n{printed}"
            printed, compared = "", compared + 1
    assert printed == "" and compared > 0


