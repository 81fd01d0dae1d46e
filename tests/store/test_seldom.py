"""Small files of what was learnt spare the SD card: they are written where something is new, and tried again later."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from hw.ports import Axis
from rotator.store.compass import CompassFile
from rotator.store.knobs import KnobsFile

OFFSETS = bytes(range(22))
EACH_FILE = pytest.mark.parametrize(
    ("opened", "known", "newer"),
    [
        (CompassFile, OFFSETS, OFFSETS[::-1]),
        (KnobsFile, {Axis.AZIMUTH: 0.9712, Axis.ELEVATION: 0.9384}, {Axis.AZIMUTH: 0.5, Axis.ELEVATION: 0.9384}),
    ],
    ids=["compass", "knobs"],
)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "run" / "learnt.json"


@EACH_FILE
def test_what_is_there_is_not_written_again(path: Path, opened: Callable[[Path], Any], known: Any, newer: Any) -> None:
    opened(path).save(known)
    again = opened(path)
    again.load()
    path.unlink()
    again.save(known)
    assert not path.exists()
    again.save(newer)
    assert opened(path).load() == newer
    path.unlink()
    again.save(newer)
    assert not path.exists(), "it was just written"


@EACH_FILE
def test_where_it_cannot_be_written_it_is_logged_and_tried_again(
    path: Path, caplog: pytest.LogCaptureFixture, opened: Callable[[Path], Any], known: Any, newer: Any
) -> None:
    path.parent.write_text("")  # a file where its folder should be: not even root writes there
    file = opened(path)
    file.save(known)
    file.save(newer)
    assert "cannot be kept" in caplog.text
    path.parent.unlink()
    file.save(newer)
    assert opened(path).load() == newer
