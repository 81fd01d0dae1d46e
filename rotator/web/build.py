"""Builds the page of the box from the configuration, the control loop and the links.

The page's part of the composition root. Knows the file with the names of paired browsers. Does not know what the page
shows.
"""

from __future__ import annotations

import logging
import socket
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rotator.assembly.fetching import fetches_file
from rotator.assembly.sky import build_site, uploaded_folder
from rotator.config.links import address
from rotator.config.mistake import counted
from rotator.config.model import Config
from rotator.control.sky.mount import Mount
from rotator.exchange.orders import GiveBack, Order, Take
from rotator.exchange.sources import PAGE, Source
from rotator.links.wire import Wire
from rotator.monitor.tap import Tap
from rotator.runtime.anew import Anew
from rotator.runtime.client import Client
from rotator.runtime.event_watch import EventWatch
from rotator.runtime.loop import ControlLoop
from rotator.store.flown import FlownPasses
from rotator.store.paired import FILE_NAME, Paired, PairedFile
from rotator.store.uploads import Uploads
from rotator.tracking.thread import TrackingThread
from rotator.views.news import News
from rotator.web.facts import Station
from rotator.web.logs import LogLines, WireLog
from rotator.web.pairing import Pairings
from rotator.web.recorder import Recorder
from rotator.web.scene import Scene
from rotator.web.thread import PageThread

if TYPE_CHECKING:
    from rotator.calibrating.on_page import PageCalibration
    from rotator.web.api import PageParts

log = logging.getLogger(__name__)


def build_pairings(config: Config, clock_trusted: Callable[[], bool]) -> Pairings | None:
    """None: the configuration has no page."""
    if not config.page.enabled:
        return None
    file = PairedFile(Path(config.state.path).with_name(FILE_NAME))
    return Pairings(file, time.monotonic, time.time, clock_trusted)


def build_page(
    config: Config,
    loop: ControlLoop,
    mount: Mount,
    pairings: Pairings,
    *,
    lcd: Callable[[], Sequence[str]],
    wires: Sequence[Wire],
    tap: Tap,
    tracking: TrackingThread,
    anew: Anew,
    calibration: PageCalibration | None = None,
    path: Path | None = None,
    clock: Callable[[], float] = time.monotonic,
    events: EventWatch | None = None,
) -> PageThread:
    """Not started yet. `lcd`: the rows of the display, a code covered. `path`: the configuration's file.

    `anew`: starts the box again with that file. `calibration`: the running calibration; None: a normal run.
    `events`: the control loop's watch over the page's event loop.
    """
    host, port = address(config.page.listen)
    lines, wire_log = LogLines(), WireLog(tap)
    tracker, known = tracking.tracker, tracking.clock_is_known
    scene = Scene(
        lambda: loop.status,
        lcd,
        wires,
        pairings.named,
        lambda: tracker.state,
        utc=time.time,
        clock_is_known=known,
        goes_on_with=lambda: tracker.goes_on_with,
    )
    recorder, news = Recorder(), News(config.notify.events, 60 * config.notify.before_min)

    def hear(_source: Source, order: Order) -> None:
        scene.note_order(order)
        recorder.note_order(order)

    loop.overhear(hear)

    def give_back_for(gone: Paired) -> None:
        source = Source(PAGE, gone.number)
        if str(source) in (loop.status.held_by, loop.status.mode_by):
            log.warning("page: %s has held the antenna: it stops, and programs may move it again", gone.name)
            loop.post(source, Take())
            loop.post(source, GiveBack())

    pairings.on_gone = give_back_for

    def parts() -> PageParts:
        # Slow to load; this function runs in the page's thread.
        from rotator.web.api import PageParts  # noqa: PLC0415
        from rotator.web.box_file import BoxFile  # noqa: PLC0415
        from rotator.web.calendar import calendar_route, plan_command  # noqa: PLC0415
        from rotator.web.elements import ElementFiles  # noqa: PLC0415
        from rotator.web.entrance import Doors  # noqa: PLC0415
        from rotator.web.favourites import FavouritesApi  # noqa: PLC0415
        from rotator.web.flown import FlownPictures  # noqa: PLC0415
        from rotator.web.help_api import help_groups  # noqa: PLC0415
        from rotator.web.overhead import OverheadApi, overhead  # noqa: PLC0415
        from rotator.web.plan import Plan, coming_passes, command  # noqa: PLC0415
        from rotator.web.setting_up import SettingUpApi  # noqa: PLC0415
        from rotator.web.settings import SettingsApi  # noqa: PLC0415
        from rotator.web.webhook import Webhook  # noqa: PLC0415

        file, favourites = BoxFile(path, anew, lambda: loop.status), FavouritesApi(tracking.favourites, tracking.sky)
        site = build_site(config.station)
        place = (site.latitude_deg, site.longitude_deg) if site else None
        passes, up, days = (
            coming_passes(command(path) if path and site else None, time.monotonic, lambda: tracking.sky.elements),
            overhead(path if site else None, time.monotonic, lambda: tracking.sky.elements),
            coming_passes(plan_command(path) if path and site else None, time.monotonic, lambda: tracking.sky.elements),
        )

        def plan_again() -> None:
            passes.forget()
            days.forget()
            tracking.follower.plan_again()

        def read_again() -> None:
            passes.forget()
            tracking.read_again()

        plan = Plan(config.sky.follow, tracking.sky, tracking.priorities, passes, changed=plan_again, utc=time.time)
        uploads, fetches = Uploads(uploaded_folder(config)), fetches_file(config)
        elements = ElementFiles(tracking.sky, uploads, fetches, config.sky.fetch, changed=read_again, utc=time.time)
        folder = Path(config.state.path).parent
        flown = FlownPictures(FlownPasses(folder), recorder, mount, lambda: loop.status, time.time)
        webhook = Webhook(config.notify, lambda: news.step(loop.status, tracking.follower.upcoming, time.time()))
        return PageParts(
            status=lambda: loop.status,
            client=lambda source: Client(loop, mount, source),
            tracking=tracking.tracker,
            station=Station(
                mount,
                config.station.beam_deg,
                (config.azimuth.tolerance_deg, config.elevation.tolerance_deg),
                place,
                calibration.axis.value if calibration else "",
            ),
            scene=scene,
            lines=lines,
            pairings=pairings,
            doors=Doors([socket.gethostname(), "rotator", host, *config.page.names], config.page.allow),
            reading_open=config.page.reading == "open",
            utc=time.time,
            calibration=calibration,
            groups=(
                lambda _entrance: (*OverheadApi(up, mount).routes(), *plan.routes(), calendar_route(days)),
                lambda _entrance: (*favourites.routes(), *elements.routes(), *flown.routes()),
                lambda _entrance: (*SettingsApi(file).routes(), *SettingUpApi(file, calibration).routes()),
                *help_groups(config, file, place, pairings=pairings, lines=lines, wires=wire_log),
            ),
            works=(
                flown.run,
                *([webhook.run] if config.notify.url else []),
            ),
            language=config.page.language,
            closes=(passes.close, up.close, days.close, elements.close),
        )

    rivals = (counted("link", at) for at, each in enumerate(config.link) if each.tcp and address(each.tcp)[1] == port)
    events = events or EventWatch(clock)
    return PageThread(host, port, parts, (lines, wire_log), clock, events=events, rival=next(rivals, ""))
