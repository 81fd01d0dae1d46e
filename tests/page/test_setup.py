"""A box is set up on the page alone: its settings, its relays one by one, and a calibration to the end."""

from __future__ import annotations

import json
import re
import signal
import socket
import subprocess
import sys
import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from rotator.assembly.simulation import PLACE_FILE
from rotator.config.load import shipped
from tests.page.conftest import START_S, STATIONS, Station, pair, until_it_answers
from tests.page.test_dashboard import PHONE, waits_for

if TYPE_CHECKING:
    from playwright.sync_api import Page

PlaywrightTimeout = pytest.importorskip("playwright.sync_api").TimeoutError

Start = Callable[..., Station]
Visit = Callable[..., "Page"]
REMARK = "[mount]\npark_azimuth_deg = 90   # away from the trees\n"


def values(station: Station) -> dict[str, Any]:
    return tomllib.loads((station.folder / "r.toml").read_text(encoding="utf-8"))


def open_step(page: Page, title: str) -> None:
    page.locator(".step > summary", has_text=title).click()


def at_setup(page: Page) -> None:
    pair(page)
    page.get_by_role("link", name="Setup").click()
    page.get_by_role("heading", name="Setup").wait_for()


def write_it(page: Page) -> None:
    """Write what is proposed, and wait until the box has started anew with it."""
    page.get_by_role("button", name="Write it and start anew").click()
    page.get_by_text("The box starts anew …").first.wait_for()
    page.get_by_text("The box starts anew …").first.wait_for(state="detached")


@pytest.mark.parametrize("how", [{}, PHONE], ids=["wide", "phone"])
def test_a_setting_is_changed_in_the_file_and_its_remark_stays(
    start: Start, visit: Visit, how: dict[str, object]
) -> None:
    station = start(REMARK)
    page = visit(station, **how)
    at_setup(page)
    open_step(page, "All settings")
    page.get_by_label("Find a setting").fill("park_azimuth_deg")
    page.get_by_label("park_azimuth_deg").fill("95")
    page.get_by_role("button", name="See the change").click()
    page.locator(".diff .new", has_text="+park_azimuth_deg = 95   # away from the trees").wait_for()
    rows = page.locator(".diff span").evaluate_all("rows => rows.map((row) => row.getBoundingClientRect().top)")
    assert len(rows) > 3
    assert rows == sorted(set(rows)), "each on a line of its own"
    write_it(page)
    assert "park_azimuth_deg = 95   # away from the trees" in (station.folder / "r.toml").read_text()
    assert "park_azimuth_deg = 90 " in (station.folder / "r.toml.bak").read_text()
    page.get_by_role("link", name="Antenna").click()
    page.get_by_role("button", name="Park", exact=True).click()
    page.get_by_text("The antenna turns to 95°").wait_for()


STANDS = re.compile(r"^(119|120)\.\d°")


@pytest.fixture
def without_file(tmp_path: Path, usual_port: None) -> Iterator[Station]:
    """`rotator run` without a file, as on the second evening: the antenna stands where the first one has left it."""
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / PLACE_FILE).write_text("[120, 10]")
    with socket.socket() as other:
        if other.connect_ex(("127.0.0.1", 8232)) == 0:
            pytest.skip("another box has the usual port of the page")
    with (tmp_path / "log").open("wb") as log:
        command = (sys.executable, "-m", "rotator", "run", "--plain")
        process = subprocess.Popen(command, cwd=tmp_path, stdout=log, stderr=subprocess.STDOUT)
    station = STATIONS["http://127.0.0.1:8232"] = Station(tmp_path, "http://127.0.0.1:8232", process)
    (tmp_path / "r.toml").write_text("")  # what `tell` names: the sockets are where they are without a file
    until_it_answers(station)
    yield station
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=START_S) == 0


def test_a_box_without_a_file_gets_one_by_one_press_and_its_antenna_stays(without_file: Station, visit: Visit) -> None:
    page = visit(without_file)
    pair(page)
    page.locator(".angles dd", has_text=STANDS).wait_for()
    page.get_by_role("link", name="Sky").click()
    page.get_by_role("link", name="Setup, step 8").first.click()
    for step in page.locator(".step > summary").all():
        step.click()
    page.get_by_role("button", name="Make a file").first.wait_for()
    for waits in ("Reading the file", "The box thinks"):
        assert page.get_by_text(waits).count() == 0
    page.get_by_role("button", name="Make a file").first.click()
    page.get_by_label("locator").first.wait_for()
    assert page.get_by_role("button", name="Make a file").count() == 0
    own = without_file.folder / "rotator.toml"
    assert own.read_text() == shipped()
    page.get_by_label("locator").first.fill("JO62qm")
    page.get_by_role("button", name="See the change").first.click()
    write_it(page)
    assert tomllib.loads(own.read_text())["station"] == {"locator": "JO62qm"}
    page.get_by_role("link", name="Antenna").click()
    page.locator(".angles dd", has_text=STANDS).wait_for()


def test_links_come_and_go(start: Start, visit: Visit) -> None:
    station = start()
    page = visit(station)
    at_setup(page)
    open_step(page, "All settings")
    page.get_by_label("Find a setting").fill("link")
    page.get_by_role("button", name="One more: [[link]]").click()
    new = page.locator("details.one", has_text="link[2]")
    new.get_by_label("protocol", exact=True).select_option("easycomm2")
    new.get_by_label("pty", exact=True).fill("ec2")
    page.get_by_role("button", name="See").click()
    write_it(page)
    assert [link["protocol"] for link in values(station)["link"]] == ["gs232b", "easycomm2"]
    first = page.locator("details.one", has_text="link[1]")
    first.locator("summary").click()
    first.get_by_role("button", name="Take link[1] out").click()
    page.get_by_role("button", name="See the change").click()
    write_it(page)
    assert [link["protocol"] for link in values(station)["link"]] == ["easycomm2"]


def test_a_pulse_moves_the_chosen_relay_alone(start: Start, visit: Visit) -> None:
    station = start()
    page = visit(station)
    at_setup(page)
    open_step(page, "Try each relay")
    pulse = page.get_by_role("button", name="Pulse elevation up")
    assert pulse.is_disabled()
    page.get_by_role("button", name="Take the antenna").click()
    pulse.click()
    waits_for(page, lambda: station.world().antenna_deg[1] > 1.0)
    waits_for(page, lambda: station.world().drives == (0, 0))
    assert abs(station.world().antenna_deg[0]) < 0.5
    assert station.world().antenna_deg[1] < 45.0


def test_a_program_is_heard_and_its_settings_are_told(start: Start, visit: Visit) -> None:
    station = start()
    page = visit(station)
    at_setup(page)
    open_step(page, "Your tracking program")
    page.get_by_label("Your tracking program").select_option("PstRotator")
    page.get_by_text("Yaesu GS-232 with the same letter, 9600 8N1").wait_for()
    page.locator(".heard", has_text="nothing heard yet").wait_for()
    with (station.folder / "gs232").open("r+b", buffering=0) as port:
        port.write(b"C2\r")
        page.locator(".heard", has_text="has just asked for the position: C2").wait_for()


class Calibration:
    """A person with the guide on the page: reads its question, presses, and answers."""

    def __init__(self, station: Station, page: Page, axis: int) -> None:
        self._station, self._page, self._axis = station, page, axis

    def asked(self, question: str) -> None:
        try:
            self._page.locator(".prompt", has_text=question).wait_for()
        except PlaywrightTimeout:
            pytest.fail(f"never asked {question!r}: {self._page.locator('.step[open]').inner_text()}")

    def turn(self, way: str) -> None:
        before = self._station.world().relay_starts
        self._page.get_by_role("button", name=way).click()
        waits_for(self._page, lambda: self._station.world().relay_starts != before)
        waits_for(self._page, lambda: self._station.world().drives == (0, 0))

    def drive_to(self, way: str, arrived: Callable[[float], bool]) -> None:
        while not arrived(self._station.world().antenna_deg[self._axis]):
            self.turn(way)

    def answer(self, name: str) -> None:
        self._page.get_by_role("button", name=name).click()

    def angle(self, degrees: float) -> None:
        self._page.get_by_label("Degrees").fill(f"{degrees:g}")
        self._page.get_by_role("button", name="Enter the degrees").click()


def calibrate(station: Station, page: Page, name: str, turns: tuple[str, str], most_deg: float) -> None:
    plus, minus = turns
    open_step(page, f"Calibrate the {name}")
    page.get_by_role("button", name=f"Calibrate the {name}").click()
    guide = Calibration(station, page, 0 if name == "azimuth" else 1)
    guide.asked("and watch the antenna")
    guide.turn(f"{plus} 2 s")
    guide.asked("Did the antenna turn")
    guide.answer("Yes")
    guide.asked("Press")
    guide.turn(f"{minus} a little")
    guide.asked("At the low end")
    guide.drive_to(f"{minus} 2 s", lambda at_deg: at_deg < 0.5)
    guide.answer("Read here")
    guide.asked("Which angle")
    guide.angle(0)
    guide.asked("At the high end")
    guide.drive_to(f"{plus} 2 s", lambda at_deg: at_deg > most_deg - 0.5)
    guide.answer("Read here")
    guide.asked("Which angle")
    guide.angle(most_deg)
    guide.asked("Another point?")
    guide.turn(f"{minus} a little")
    guide.answer("One back")
    page.locator(".guide-lines", has_text=f"Taken back: {most_deg:g}°.").wait_for()
    guide.asked("At the high end")
    guide.drive_to(f"{plus} 2 s", lambda at_deg: at_deg > most_deg - 0.5)
    guide.answer("Read here")
    guide.asked("Which angle")
    guide.angle(most_deg)
    guide.asked("Another point?")
    guide.answer("No more points")
    guide.asked("Lowest angle")
    guide.angle(2)
    guide.asked("Highest angle")
    guide.angle(most_deg - 2)
    guide.asked("Save this?")
    guide.answer("Yes")
    page.locator(".guide-lines", has_text="Saved in").wait_for()
    # At its stop the box could not see the relay open. A person has looked.
    page.get_by_role("button", name=f"Both relays of the {name} are open").click()
    page.get_by_role("button", name="I have seen it").click()
    page.get_by_text(f"whether a relay of the {name} has opened").wait_for(state="detached")
    open_step(page, f"Calibrate the {name}")


@pytest.mark.usefixtures("usual_port")
def test_from_nothing_to_a_calibrated_rotor(start: Start, visit: Visit) -> None:
    station = start()
    page = visit(station)
    at_setup(page)
    open_step(page, "Which rotor")
    page.get_by_label("Which rotor?").select_option("g5500")
    page.get_by_label("Is the rotor wired").select_option("sim")
    page.get_by_label("How many degrees does azimuth turn").fill("360")
    page.get_by_label("Which program turns").select_option("gs232b")
    page.get_by_label("Where does the antenna stand?").fill("JO62qm")
    page.get_by_role("button", name="See the new file").click()
    write_it(page)
    written = values(station)
    assert written["azimuth"]["max_deg"] == 360
    assert written["station"]["locator"] == "JO62qm"
    assert written["page"]["listen"] in station.url, "the page stays where it is"
    open_step(page, "Which rotor")
    calibrate(station, page, "azimuth", ("CW ▶", "◀ CCW"), 360.0)
    calibrate(station, page, "elevation", ("up ▲", "▼ down"), 180.0)
    written = values(station)
    for axis, most_deg in (("azimuth", 358), ("elevation", 178)):
        assert written[axis]["direction_checked"] is True
        assert (written[axis]["min_deg"], written[axis]["max_deg"]) == (2, most_deg)
        assert len(written[axis]["calibration"]) == 2
    for name in ("azimuth", "elevation"):
        summary = page.locator(".step > summary", has_text=f"Calibrate the {name}")
        summary.get_by_text("done").wait_for()
    status = json.loads(station.tell("status", "json"))
    assert [status[axis]["missing"] for axis in ("azimuth", "elevation")] == [[], []]


def test_a_motor_stops_when_the_browser_of_a_calibration_goes(start: Start, visit: Visit) -> None:
    station = start()
    page = visit(station)
    at_setup(page)
    open_step(page, "Calibrate the azimuth")
    page.get_by_role("button", name="Calibrate the azimuth").click()
    page.locator(".prompt", has_text="and watch the antenna").wait_for()
    page.get_by_role("button", name="CW ▶ 2 s").click()
    waits_for(page, lambda: station.world().drives == (1, 0))
    page.context.set_offline(True)
    waits_for(page, lambda: station.world().drives == (0, 0))
