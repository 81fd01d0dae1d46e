"""A file that is no TOML: the person reads which line it is, and what to write."""

from __future__ import annotations

from pathlib import Path

import pytest

from rotator.config.load import ConfigError, load
from rotator.config.save import save_axis


@pytest.mark.parametrize(
    ("text", "advice"),
    [
        ("[azimuth]\nmin_deg = 0,5\n", "'min_deg = 0,5': write the number with a point, 0.5"),
        ("[azimuth]\nmin_deg = -10,25  # west\n", "write the number with a point, -10.25"),
        (
            "[azimuth]\nmin_deg = 0\n[azimuth]\nmax_deg = 360\n",
            "[azimuth] is in the file already: write its keys there",
        ),
        ("[azimuth]\nmin_deg = 0\nmin_deg = 1\n", "'min_deg = 1': this key is in its table already"),
        ("[azimuth]\nmin_deg 0\n", "'min_deg 0'"),
    ],
)
def test_the_line_and_what_to_write(tmp_path: Path, text: str, advice: str) -> None:
    path = tmp_path / "rotator.toml"
    path.write_text(text)
    with pytest.raises(ConfigError) as wrong:
        load(path)
    assert advice in str(wrong.value)


def test_a_byte_order_mark_is_no_fault(tmp_path: Path) -> None:
    path = tmp_path / "rotator.toml"
    path.write_text("[azimuth]\nmin_deg = 10\n", encoding="utf-8-sig")
    assert load(path).azimuth.min_deg == 10.0
    save_axis(path, "azimuth", max_deg=300.0)
    assert load(path).azimuth.max_deg == 300.0
