"""The pictures of the last passes: so many and no more, and a name from space that is no path."""

from __future__ import annotations

import json
from dataclasses import asdict, replace
from pathlib import Path

import pytest

from rotator.store.flown import MOST, MOST_FIGURES, FlownPass, FlownPasses, picture_name

EVENING_S = 1_740_787_200.0


def flown(index: int) -> FlownPass:
    begin_s = EVENING_S + 6000.0 * index
    return FlownPass(picture_name("ISS", begin_s), "ISS", begin_s, begin_s + 600.0, 0.5, 2.0, 31)


@pytest.mark.parametrize(
    ("name", "file"),
    [
        ("ISS (ZARYA)", "20250301-000000-iss-zarya.svg"),
        ("../../etc", "20250301-000000-etc.svg"),
        ("☃", "20250301-000000-pass.svg"),
        ("x" * 80, f"20250301-000000-{'x' * 40}.svg"),
    ],
)
def test_the_name_of_a_picture(name: str, file: str) -> None:
    assert picture_name(name, EVENING_S) == file


def test_the_latest_are_kept_and_outlive_the_program(tmp_path: Path) -> None:
    """Of the last weeks the figures, of the last passes picture and table too."""
    passes = FlownPasses(tmp_path)
    (tmp_path / "flown").mkdir()
    for kind in ("svg", "csv"):
        (tmp_path / "flown" / f"mine.{kind}").write_text("a person's own")
    last = MOST_FIGURES + 2
    for index in range(last + 1):
        passes.keep(flown(index), f"<svg>{index}</svg>", f"t\n{index}\n")
    again = FlownPasses(tmp_path)
    assert list(again.passes) == [flown(index) for index in range(last, 2, -1)]
    for kind in ("svg", "csv"):
        assert len(list((tmp_path / "flown").glob(f"2*.{kind}"))) == MOST
        assert (tmp_path / "flown" / f"mine.{kind}").exists()
    assert again.picture(flown(last).file) == f"<svg>{last}</svg>"
    assert again.table(flown(last).file) == f"t\n{last}\n"
    assert again.picture(flown(3).file) is again.table(flown(3).file) is None


def test_the_figures_of_the_longest_list_fit_into_its_file(tmp_path: Path) -> None:
    passes = FlownPasses(tmp_path)
    for index in range(MOST_FIGURES):
        figures = replace(flown(index), p95_deg=179.99, max_el_deg=89.9, motor_s=1799.9, faults=("x" * 40,) * 2)
        passes.keep(replace(figures, name="☃" * 40), "<svg/>")
    assert FlownPasses(tmp_path).passes == passes.passes


@pytest.mark.parametrize("file", ["../flown.json", "mine.svg", "", "/etc/passwd"])
def test_no_other_file_is_a_picture(tmp_path: Path, file: str) -> None:
    passes = FlownPasses(tmp_path)
    passes.keep(flown(0), "<svg/>")
    (tmp_path / "flown" / "mine.svg").write_text("a person's own")
    assert passes.picture(file) is None


def test_a_picture_that_is_too_large_is_not_kept(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    passes = FlownPasses(tmp_path)
    passes.keep(flown(0), "x" * 300_001)
    assert not passes.passes
    passes.keep(flown(1), "x" * 300_000)
    assert [each.file for each in passes.passes] == [flown(1).file]
    assert "is not kept" in caplog.text


def listed(folder: Path, **figures: object) -> FlownPass | None:
    """The one pass of a list whose file has these figures; None: the list begins anew."""
    FlownPasses(folder).keep(flown(0), "<svg/>")
    whole = json.loads((folder / "flown.json").read_text())
    whole["passes"][0].update(figures)
    (folder / "flown.json").write_text(json.dumps(whole))
    passes = FlownPasses(folder).passes
    return passes[0] if passes else None


@pytest.mark.parametrize(
    ("key", "least", "most"),
    [
        ("begin_utc_s", 0.0, 4_102_444_800.0),
        ("end_utc_s", 0.0, 4_102_444_800.0),
        ("rms_deg", 0.0, 180.0),
        ("max_deg", 0.0, 180.0),
        ("relay_starts", 0, 1_000_000),
        ("p95_deg", 0.0, 180.0),
        ("max_el_deg", 0.0, 90.0),
        ("motor_s", 0.0, 1_000_000.0),
    ],
)
def test_figures_of_no_pass_begin_the_list_anew(tmp_path: Path, key: str, least: float, most: float) -> None:
    for value in (least, most):
        kept = listed(tmp_path, **{key: value})
        assert kept is not None
        assert getattr(kept, key) == value
    for wrong in (least - 0.5, most + 0.5, "31"):
        assert listed(tmp_path, **{key: wrong}) is None


def test_a_rotor_without_relays_has_no_relay_starts(tmp_path: Path) -> None:
    kept = listed(tmp_path, relay_starts=None, name="x" * 50)
    assert kept is not None
    assert (kept.relay_starts, kept.name) == (None, "x" * 40)


def test_the_list_of_an_earlier_program_lacks_some_figures(tmp_path: Path) -> None:
    row = {key: value for key, value in asdict(flown(0)).items() if value is not None}
    (tmp_path / "flown.json").write_text(json.dumps({"format": "rotator flown 1", "passes": [row]}))
    assert FlownPasses(tmp_path).passes == (flown(0),)


def test_a_list_that_is_too_long_is_cut(tmp_path: Path) -> None:
    row = asdict(flown(0))
    (tmp_path / "flown.json").write_text(
        json.dumps({"format": "rotator flown 1", "passes": [row] * (MOST_FIGURES + 1)})
    )
    assert len(FlownPasses(tmp_path).passes) == MOST_FIGURES


def test_a_pass_flown_again_replaces_its_picture(tmp_path: Path) -> None:
    passes = FlownPasses(tmp_path)
    for picture in ("<svg>1</svg>", "<svg>2</svg>"):
        passes.keep(flown(0), picture)
    assert passes.picture(flown(0).file) == "<svg>2</svg>"
    assert len(passes.passes) == 1


def test_a_picture_that_cannot_be_written_is_not_listed(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    (tmp_path / "flown").write_text("a file where its folder should be")
    passes = FlownPasses(tmp_path)
    passes.keep(flown(0), "<svg/>")
    assert not passes.passes
    assert "the picture of ISS cannot be kept" in caplog.text


def test_a_list_that_names_another_file_begins_anew(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    (tmp_path / "flown.json").write_text('{"format": "rotator flown 1", "passes": [{"file": "../state.json"}]}')
    assert not FlownPasses(tmp_path).passes
    assert "it begins anew" in caplog.text
