"""A backup and the way back: checked whole, put in place whole, and what was there is kept."""

from __future__ import annotations

import io
import struct
import zipfile
from collections.abc import Iterator
from pathlib import Path

import hypothesis.strategies as st
import pytest
from hypothesis import given

from hw.ports import Axis
from rotator.backup.content import ABOUT, CHECKS, CONFIGURATION, FORM, STATE, BackupError, check, pack
from rotator.backup.restore import BEFORE, FAILED, UNDER_WAY, WAITING, complete, stage
from rotator.config.load import parse
from rotator.exchange.status import Latch
from rotator.store.json_file import encode
from rotator.store.latch import LATCH
from rotator.store.learnt import COMPASS, KNOBS, LEARNT, FullScales
from rotator.store.priorities import PRIORITIES, Changed
from rotator.store.state import FORM as STATE_FORM
from rotator.store.state import SPARED, State
from rotator.store.whole import write_whole

ABOUT_TEXT = '{"format": "rotator backup 1", "made": "2026-11-23T12:00:00Z", "program": "0.1.0"}'
EARLIER_KNOBS = '{"format": "rotator knobs 1", "full_scales": {"azimuth": 0.93}}'
SCALES, OTHER_SCALES = {Axis.AZIMUTH: 0.93}, {Axis.AZIMUTH: 0.71}
TOML = """# our mast
[rotor]
hardware = "sim"
[azimuth]
max_deg = {}  # the stop
[state]
path = "{}/state.json"
"""


class Station:
    """A configuration and a state in a folder."""

    def __init__(self, folder: Path) -> None:
        folder.mkdir()
        self.folder = folder
        self.path = folder / "station.toml"
        self.write(450, SCALES)

    @property
    def state(self) -> State:
        return State(self.folder / STATE)

    def write(self, max_deg: int, scales: FullScales) -> None:
        self.path.write_text(TOML.format(max_deg, self.folder), encoding="utf-8")
        self.state.keep(KNOBS, scales)

    def packed(self) -> bytes:
        return pack(self.path, parse(self.path.read_text(), "test"), 0.0)

    def everything(self) -> dict[str, str]:
        files = (each for each in self.folder.iterdir() if not each.name.endswith((WAITING, UNDER_WAY, FAILED, BEFORE)))
        return {each.name: each.read_text() for each in files}


@pytest.fixture
def station(tmp_path: Path) -> Station:
    return Station(tmp_path / "box")


def zipped(*files: tuple[str, str | bytes]) -> bytes:
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as file:
        for name, content in files:
            file.writestr(name, content)
    return packed.getvalue()


def with_more(name: str) -> bytes:
    return zipped((ABOUT, ABOUT_TEXT), (CONFIGURATION, ""), (name, EARLIER_KNOBS))


def with_state(**sections: object) -> bytes:
    return zipped((ABOUT, ABOUT_TEXT), (CONFIGURATION, ""), (STATE, encode(STATE_FORM, sections)))


def test_what_was_saved_comes_back_with_its_comments_and_what_was_there_is_kept(station: Station) -> None:
    kept, saved = station.everything(), station.packed()
    station.write(360, OTHER_SCALES)
    changed = station.everything()
    stage(station.path, saved)
    assert station.everything() == changed, "the running box is left alone"
    assert complete(station.path, 0.0)
    assert station.everything() == kept
    assert not complete(station.path, 0.0), "once"
    stage(station.path, (station.folder / f"station.toml{BEFORE}").read_bytes())
    assert complete(station.path, 0.0)
    assert station.everything() == changed, "and back again"


def test_a_start_without_a_backup_that_waits_changes_nothing(station: Station) -> None:
    kept = station.everything()
    assert not complete(station.path, 0.0)
    assert not complete(station.folder / "not there.toml", 0.0)
    assert station.everything() == kept


def test_another_pi_gets_the_whole_box(station: Station, tmp_path: Path) -> None:
    saved, new = station.packed(), tmp_path / "new.toml"
    new.write_text("this card has a file that cannot be used", encoding="utf-8")
    stage(new, saved)
    assert complete(new, 0.0)
    assert new.read_text() == station.path.read_text()


def test_a_stop_and_doubted_relays_and_pairings_stay_in_the_box(station: Station) -> None:
    for name in ("counts.json", "paired.json"):
        (station.folder / name).write_text("{}", encoding="utf-8")
    station.state.keep(LATCH, Latch("panel"))
    saved = station.packed()
    with zipfile.ZipFile(io.BytesIO(saved)) as file:
        assert set(file.namelist()) == {ABOUT, CONFIGURATION, STATE}
    assert set(check(saved).parts) == {"knobs"}
    station.state.keep(LATCH, Latch("page#2", storm=True))
    stage(station.path, saved)
    assert complete(station.path, 0.0)
    assert station.state.load(LATCH) == Latch("page#2", storm=True), "a backup ends no stop"
    assert not set(SPARED) & set(CHECKS), "nor has it what memory may know better"


def test_a_backup_of_an_earlier_version_had_a_file_for_each(station: Station) -> None:
    assert check(with_more("knobs.json")).parts == {"knobs": KNOWN}
    data = zipped((ABOUT, ABOUT_TEXT), (CONFIGURATION, station.path.read_text()), ("knobs.json", EARLIER_KNOBS))
    station.write(360, OTHER_SCALES)
    stage(station.path, data)
    assert complete(station.path, 0.0)
    assert station.state.load(KNOBS) == SCALES


def test_a_restored_part_is_not_hidden_by_a_file_of_an_earlier_version(station: Station) -> None:
    saved = station.packed()
    (station.folder / "knobs.json").write_text(EARLIER_KNOBS.replace("0.93", "0.5"), encoding="utf-8")
    (station.folder / "latch.json").write_text('{"format": "rotator latch 1", "by": "panel", "storm": false}')
    stage(station.path, saved)
    assert complete(station.path, 0.0)
    assert station.state.load(KNOBS) == SCALES
    assert station.state.load(LATCH) == Latch("panel")


def test_the_state_of_a_later_version_is_not_overwritten(station: Station, caplog: pytest.LogCaptureFixture) -> None:
    saved = station.packed()
    station.state.path.write_text('{"format": "rotator state 3"}')
    kept = station.everything()
    stage(station.path, saved)
    assert not complete(station.path, 0.0)
    assert station.everything() == kept
    assert "a later version" in caplog.text


BAD: dict[str, tuple[bytes, str]] = {
    "no zip": (b"hello", "no backup of a rotator, or it is damaged"),
    "empty": (b"", "no backup of a rotator, or it is damaged"),
    "another zip": (zipped(("photo.jpg", "x")), "it holds 'photo.jpg'"),
    "nothing of ours": (zipped(), "backup.json is not in it"),
    "no configuration": (zipped((ABOUT, ABOUT_TEXT)), "rotator.toml is not in it"),
    "a later one": (
        zipped((ABOUT, ABOUT_TEXT.replace("backup 1", "backup 2")), (CONFIGURATION, "")),
        "a later version of the program wrote it: its format is 'rotator backup 2', not 'rotator backup 1'. Update",
    ),
    "another form": (zipped((ABOUT, '{"format": "x"}'), (CONFIGURATION, "")), "its format is not"),
    "no JSON": (zipped((ABOUT, "{" * 9999), (CONFIGURATION, "")), "no backup of a rotator"),
    "a mistake": (zipped((ABOUT, ABOUT_TEXT), (CONFIGURATION, "[azimuth]\nmax_deg = 9999\n")), "azimuth.max_deg"),
    "a later file": (zipped((ABOUT, ABOUT_TEXT), (CONFIGURATION, "format = 99\n")), "later version"),
    "later knobs": (
        zipped((ABOUT, ABOUT_TEXT), (CONFIGURATION, ""), ("knobs.json", EARLIER_KNOBS.replace("knobs 1", "knobs 9"))),
        "knobs.json of the backup: a later version",
    ),
    "wrong knobs": (
        zipped((ABOUT, ABOUT_TEXT), (CONFIGURATION, ""), ("knobs.json", EARLIER_KNOBS.replace("0.93", "7"))),
        "knobs.json of the backup: the azimuth knob's full scale is 7",
    ),
    "wrong knobs in the state": (
        with_state(knobs={"full_scales": {"azimuth": 7}}),
        "state.json of the backup: the azimuth knob's full scale is 7",
    ),
    "a stop": (with_state(latch={"by": "", "storm": False}), "state.json of the backup: 'latch' belongs to no backup"),
    "wrong motors": (
        zipped((ABOUT, ABOUT_TEXT), (CONFIGURATION, ""), ("state.json", '{"format": "rotator state 1", "axes": 3}')),
        "state.json of the backup",
    ),
    "a way out": (with_more("../knobs.json"), "it holds '../knobs.json'"),
    "the root": (with_more("/etc/passwd"), "it holds '/etc/passwd'"),
    "a name of Windows": (with_more("..\\knobs.json"), "it holds"),
    "not for a backup": (with_more("paired.json"), "it holds 'paired.json'"),
    "a bomb": (zipped((ABOUT, ABOUT_TEXT), (CONFIGURATION, b"#" * 20_000_000)), "has more than 300 kB"),
    "too long": (b"x" * 2_000_000, "more than 1 MB"),
    "no text": (zipped((ABOUT, ABOUT_TEXT), (CONFIGURATION, b"\xff\xfe")), "no text"),
}  # fmt: skip


@pytest.mark.parametrize("name", BAD)
def test_what_is_no_backup_of_this_program_is_refused_with_a_sentence_and_changes_nothing(
    station: Station, name: str
) -> None:
    kept = station.everything()
    data, says = BAD[name]
    with pytest.raises(BackupError) as refused:
        stage(station.path, data)
    assert says in str(refused.value)
    assert not complete(station.path, 0.0)
    assert station.everything() == kept


def test_one_name_twice_is_refused() -> None:
    with pytest.warns(UserWarning, match="Duplicate name"):
        data = zipped((ABOUT, ABOUT_TEXT), (CONFIGURATION, ""), (CONFIGURATION, "[page]\n"))
    with pytest.raises(BackupError, match=r"it holds 'rotator\.toml'"):
        check(data)


@pytest.mark.parametrize("packing", [zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA])
def test_another_packing_is_refused_damaged_or_not(packing: int) -> None:
    """Its unpacker asks for the memory that the file names, and fails in a way of its own."""
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", packing) as file:
        file.writestr(ABOUT, ABOUT_TEXT)
    whole = packed.getvalue()
    for data in (whole, whole.replace(whole[60:70], b"\xff" * 10)):
        with pytest.raises(BackupError, match=f"{ABOUT} is packed in another way"):
            check(data)


def test_a_bomb_that_lies_about_its_size_is_not_unpacked() -> None:
    data = bytearray(zipped((ABOUT, ABOUT_TEXT), (CONFIGURATION, b"#" * 5_000_000)))
    for at in (data.rindex(b"PK\x01\x02") + 24, data.rindex(b"PK\x03\x04") + 22):
        struct.pack_into("<I", data, at, 10)
    with pytest.raises(BackupError):
        check(bytes(data))


KNOWN = {"full_scales": {"azimuth": 0.93}}


@given(st.data())
def test_a_damaged_backup_is_refused_or_whole(data: st.DataObject) -> None:
    whole = bytearray(
        zipped((ABOUT, ABOUT_TEXT), (CONFIGURATION, "[azimuth]\nmax_deg = 400\n"), ("knobs.json", EARLIER_KNOBS))
    )
    for _ in range(data.draw(st.integers(1, 3))):
        whole[data.draw(st.integers(0, len(whole) - 1))] = data.draw(st.integers(0, 255))
    cut = whole[: data.draw(st.integers(0, len(whole)))] if data.draw(st.booleans()) else whole
    try:
        found = check(bytes(cut))
    except BackupError:
        return
    assert found.config.azimuth.max_deg == 400
    assert found.parts.get("knobs", KNOWN) == KNOWN


class PowerCut(BaseException):
    pass


def test_after_a_power_cut_at_any_step_the_next_start_has_the_new_box_and_the_old_one_is_kept(tmp_path: Path) -> None:
    outcomes = set()
    for cut_at in range(5):
        station = Station(tmp_path / f"box{cut_at}")
        new, saved = station.everything(), station.packed()
        station.write(360, OTHER_SCALES)
        old = station.everything()
        stage(station.path, saved)
        steps = iter(range(9))

        def cut(path: Path, content: str | bytes, at: int = cut_at, steps: Iterator[int] = steps) -> None:
            if next(steps) == at:
                raise PowerCut
            write_whole(path, content)

        try:
            complete(station.path, 0.0, cut)
        except PowerCut:
            outcomes.add(cut_at)
        complete(station.path, 0.0)
        assert station.everything() == new
        before = check((station.folder / f"station.toml{BEFORE}").read_bytes())
        assert before.text == old["station.toml"]
        assert KNOBS.parse(before.parts["knobs"]) == OTHER_SCALES
    assert outcomes == {0, 1, 2}, "the backup of what is there, the state, the configuration"


def test_a_disk_that_is_full_leaves_the_old_box(station: Station, caplog: pytest.LogCaptureFixture) -> None:
    saved = station.packed()
    station.write(360, OTHER_SCALES)
    old = station.everything()
    stage(station.path, saved)
    # A folder in the way of the new file: it cannot be written, as on a full disk.
    (station.folder / "station.toml.new").mkdir()
    try:
        assert not complete(station.path, 0.0)
    finally:
        (station.folder / "station.toml.new").rmdir()
    assert station.everything() == old
    assert "not restored, the box is as it was" in caplog.text
    assert not complete(station.path, 0.0), "it is not tried for ever"
    assert (station.folder / f"station.toml{FAILED}").exists()


def test_what_the_motors_taught_and_the_compass_found_go_along(station: Station) -> None:
    motors = {"speed_dps": 6.0, "coast_deg": 0.9}
    state = station.state
    state.note(LEARNT, {Axis.AZIMUTH: {"begun": {"speed_dps": 6.0}, "plus": motors, "minus": motors}})
    state.note(PRIORITIES, {"ISS": Changed(3.0, 1.0)})
    state.keep(COMPASS, bytes(22))
    assert check(station.packed()).parts == state.sections
    assert FORM.today == "rotator backup 1"


def test_what_is_damaged_is_left_out(station: Station) -> None:
    station.state.keep(COMPASS, b"")
    assert set(check(station.packed()).parts) == {"knobs"}
