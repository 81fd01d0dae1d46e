"""Each benchmark that takes arguments explains them when it is asked with `--help`, and measures nothing."""

from __future__ import annotations

import runpy
import sys
from pathlib import Path

import pytest

import benchmarks

FOLDER = Path(benchmarks.__file__).parent
READS_ARGUMENTS = {"import argparse", "from benchmarks.numbers import numbers"}


def takes_arguments(path: Path) -> bool:
    lines = set(path.read_text(encoding="utf-8").splitlines())
    return 'if __name__ == "__main__":' in lines and not READS_ARGUMENTS.isdisjoint(lines)


ASKED = [path for path in sorted(FOLDER.rglob("*.py")) if takes_arguments(path)]


@pytest.mark.parametrize("path", ASKED, ids=lambda path: str(path.relative_to(FOLDER)))
def test_it_says_what_it_measures_and_ends(
    path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    if path.is_relative_to(FOLDER / "mutants"):
        pytest.importorskip("cosmic_ray", reason="cosmic-ray is missing: make mutants puts it in")
    monkeypatch.setattr(sys, "argv", [str(path), "--help"])
    with pytest.raises(SystemExit) as ended:
        runpy.run_path(str(path), run_name="__main__")
    assert ended.value.code == 0
    said = capsys.readouterr().out
    assert said.startswith("usage: ")
    assert len(said.splitlines()) > 5
