"""Who may give orders, as a person meets it: an unpaired phone, a pairing that has ended, a closed box."""

from __future__ import annotations

import json
import signal
from collections.abc import Callable
from typing import TYPE_CHECKING

from rotator.store import paired
from rotator.web.pairing import LASTS_S
from tests.page.conftest import START_S, Station, code_at_the_box, headline, pair
from tests.page.test_dashboard import PHONE

if TYPE_CHECKING:
    from playwright.sync_api import Page

Start = Callable[..., Station]
Visit = Callable[..., "Page"]
CLOSED = 'reading = "paired"\n'


def test_a_lost_phone_is_unpaired_by_another_browser_and_its_button_turns_no_more(start: Start, visit: Visit) -> None:
    station = start()
    lost, mine = visit(station, **PHONE), visit(station)
    pair(lost, "lost phone")
    pair(mine, "mine")
    lost.get_by_role("button", name="Hold to turn CW", exact=True).scroll_into_view_if_needed()
    lost.get_by_role("button", name="Hold to turn CW", exact=True).hover()
    lost.mouse.down()
    headline(mine, "TURNING")
    mine.locator(".connection a").click()
    mine.get_by_role("button", name="Unpair lost phone").click()
    mine.get_by_text("lost phone", exact=True).wait_for(state="detached")
    mine.get_by_role("link", name="Antenna").click()
    headline(mine, "AT REST")
    assert station.world().drives == (0, 0)
    lost.get_by_role("button", name="Pair this browser").wait_for()
    assert lost.get_by_role("button", name="Point there").count() == 0


def test_a_pairing_that_was_not_used_for_half_a_year_has_ended(start: Start, visit: Visit) -> None:
    station = start()
    page = visit(station)
    pair(page, "old phone")
    station.process.send_signal(signal.SIGINT)
    station.process.wait(timeout=START_S)
    file = station.folder / paired.FILE_NAME
    kept = json.loads(file.read_text())
    for each in kept["paired"]:
        each["since_s"] -= LASTS_S + 3600.0
        each["seen_s"] -= LASTS_S + 3600.0
    file.write_text(json.dumps(kept))
    # Its cookie belongs to the machine, whatever the port.
    page.goto(start().url)
    page.get_by_role("button", name="Pair this browser").wait_for()
    assert page.get_by_role("button", name="Point there").count() == 0
    pair(page, "old phone, again")


def test_a_box_that_shows_itself_to_paired_browsers_alone_lets_a_new_one_pair(start: Start, visit: Visit) -> None:
    station = start(page=CLOSED)
    page = visit(station, shows=".pair", **PHONE)
    page.get_by_text("This box shows itself to paired browsers alone.").wait_for()
    assert page.locator(".headline").count() == 0
    page.get_by_role("button", name="Pair this browser").click()
    page.get_by_label("Code").fill(code_at_the_box(page))
    page.get_by_role("button", name="Pair", exact=True).click()
    page.get_by_role("button", name="Point there").wait_for()
    headline(page, "AT REST")
