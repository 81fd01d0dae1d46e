"""What helps when something is wrong: the doctor and the bytes of the links, in the browser."""

from __future__ import annotations

import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from tests.page.conftest import LOOK_MS, PATIENCE_MS, Station, pair, violations

if TYPE_CHECKING:
    from playwright.sync_api import Page

Start = Callable[..., Station]
Visit = Callable[..., "Page"]
UNPLUGGED = '[[link]]\nprotocol = "md01"\nserial = "/dev/ttyUSB77"\n'


def send(station: Station, line: bytes) -> None:
    with (station.folder / "gs232").open("r+b", buffering=0) as program:
        program.write(line)


def test_the_doctor_says_what_to_repair_and_how_before_all_that_is_good(start: Start, visit: Visit) -> None:
    page = visit(start(UNPLUGGED))
    page.get_by_role("link", name="Help").click()
    page.get_by_text("1 to repair").wait_for()
    first = page.locator(".doctor li").first
    assert "/dev/ttyUSB77 is not there" in first.inner_text()
    assert "Plug it in" in first.locator(".advice").inner_text()
    assert page.locator(".doctor .good", has_text="configuration").count() == 1


def test_a_check_is_made_again_when_it_is_asked_for(start: Start, visit: Visit) -> None:
    station = start()
    page = visit(station)
    page.get_by_role("link", name="Help").click()
    page.get_by_text("it runs, and no axis has a fault").wait_for()
    station.tell("stop")
    for _ in range(PATIENCE_MS // LOOK_MS):
        page.get_by_role("button", name="Check again").click()
        page.locator(".doctor button:enabled").wait_for()
        if page.locator(".doctor .warning", has_text="stopped by").count():
            return
        page.wait_for_timeout(LOOK_MS)
    pytest.fail(page.locator(".doctor").inner_text())


def test_what_a_program_sends_is_seen_byte_by_byte(start: Start, visit: Visit) -> None:
    station = start(UNPLUGGED)
    page = visit(station)
    pair(page)
    page.get_by_role("link", name="Help").click()
    page.get_by_role("link", name="Wires").click()
    send(station, b"C2\r")
    page.locator(".bytes .came", has_text="C2\\r").wait_for()
    page.locator(".bytes .went", has_text="AZ=").wait_for()
    page.get_by_role("combobox", name="Link").select_option("md01")
    page.get_by_text("Nothing has come yet").wait_for()
    page.get_by_role("combobox", name="Link").select_option("gs232b")
    page.locator(".bytes .came", has_text="C2\\r").wait_for()


def test_a_backup_is_saved_and_restored_with_one_question(start: Start, visit: Visit, tmp_path: Path) -> None:
    station = start()
    page = visit(station)
    pair(page)
    page.get_by_role("link", name="Help").click()
    page.get_by_role("link", name="Files").click()
    with page.expect_download() as saving:
        page.get_by_role("link", name="Save a backup").click()
    saved = tmp_path / "saved.zip"
    saving.value.save_as(saved)
    file, text = station.folder / "r.toml", (station.folder / "r.toml").read_text()
    file.write_text(f"{text}# a mistake of mine\n")
    page.get_by_label("A backup").set_input_files(saved)
    page.get_by_text("The lines of the file").click()
    page.locator(".diff .gone", has_text="a mistake of mine").wait_for()
    assert violations(page) == []
    page.get_by_role("button", name="Restore it").click()
    page.get_by_text("Restored: the box runs with it").wait_for()
    assert file.read_text() == text
    page.get_by_label("A backup").set_input_files(station.folder / "r.toml.before-restore.zip")
    page.get_by_text("The lines of the file").click()
    page.locator(".diff .new", has_text="a mistake of mine").wait_for()


def test_the_diagnostics_are_a_file_to_keep(start: Start, visit: Visit) -> None:
    page = visit(start())
    pair(page)
    page.get_by_role("link", name="Help").click()
    page.get_by_role("link", name="Files").click()
    with page.expect_download() as saving:
        page.get_by_role("link", name="Save diagnostics").click()
    assert saving.value.suggested_filename == "rotator-diagnostics.zip"
    with zipfile.ZipFile(saving.value.path()) as file:
        assert "rotator/README.txt" in file.namelist()


def test_the_log_is_copied_and_saved_as_it_is_shown(start: Start, visit: Visit) -> None:
    station = start()
    page = visit(station)
    pair(page, "Anna's phone")
    station.tell("stop")
    page.get_by_role("link", name="Help").click()
    page.get_by_role("link", name="Log").click()
    page.locator(".log tr", has_text="Anna's phone is paired").wait_for()
    page.get_by_role("searchbox").fill("anna")
    with page.expect_download() as saving:
        page.get_by_role("button", name="Save").click()
    (line,) = saving.value.path().read_text().splitlines()
    assert line.endswith("Z note    the page: Anna's phone is paired")
    page.get_by_role("button", name="Copy").click()
    page.get_by_text("1 line copied").wait_for()
    page.get_by_role("searchbox").press("Control+a")
    page.get_by_role("searchbox").press("Control+v")
    assert page.get_by_role("searchbox").input_value() == line
