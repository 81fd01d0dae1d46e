"""`rotator calibrate`: starts a calibration session on the terminal, or on standard input and output.

It refuses to start beside a running box. After a latched stop it first asks whether the mast is free.
`calibrating.session` runs the guides, which ask the questions; `calibrate_screens` shows them.
"""

from __future__ import annotations

import asyncio
import logging
import os
import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

import click
from rich.console import Console

from hw.ports import Axis
from rotator.assembly.kept_files import build_latch_file
from rotator.assembly.sky import build_catalogue, build_site
from rotator.assembly.station import Station, open_station
from rotator.calibrating.receiver import BadAddress
from rotator.calibrating.session import SKY, CalibrationSession
from rotator.calibrating.sky_rig import check
from rotator.calibrating.sky_table import Residuals
from rotator.cli.announced import announced
from rotator.cli.calibrate_screens import LivePicture, PlainLines, wrapped
from rotator.cli.failed import CommandFailed
from rotator.cli.faults import fault_names, parse_faults
from rotator.cli.reach import connected, consoles
from rotator.cli.run import make_sure_of
from rotator.cli.screen import log_to, stop_on_signals
from rotator.config.load import load
from rotator.config.model import Config
from rotator.config.places import memory_folder, monitor_path
from rotator.config.station import NO_PLACE
from rotator.exchange.spoken import held_by, spoken
from rotator.orbits.catalogue import Unknown
from rotator.orbits.sight import NotThere, Target
from rotator.orbits.targets import find
from rotator.store.whole import write_whole
from rotator.views.residual_svg import residual_svg


def calibrate_axes(path: Path | None, faults: tuple[str, ...], task: str | None, *, plain: bool) -> int:
    """`task`: an axis, `north`, or None for both axes. The exit code: 0 when everything has been set up."""
    chosen = parse_faults(faults, fault_names(path)) if faults else []
    config = load(path)
    _refuse_beside_running_box(config, path)
    _refuse_stopped(config, path)
    tasks = [axis.value for axis in Axis] if task is None else [task]
    return asyncio.run(_run(config, path, chosen, tasks, plain=plain))


def calibrate_sky(
    path: Path | None,
    faults: tuple[str, ...],
    words: str,
    at_s: float | None,
    *,
    plain: bool,
    receiver: str | None = None,
    svg: Path | None = None,
) -> int:
    """`words`: the target's name. `at_s`: the moment at which a simulated calibration begins; None: now.

    `receiver`: the address of its rigctld, or `sim`; None: a person finds the target. `svg`: the picture of the points.
    """
    chosen = parse_faults(faults, fault_names(path)) if faults else []
    config = load(path)
    if config.rotor.hardware != "sim" and at_s is not None:
        raise CommandFailed("--at is for a simulated rotor: a real antenna points where the target is now")
    _refuse_beside_running_box(config, path)
    _refuse_stopped(config, path)
    later_s = 0.0 if at_s is None else at_s - time.time()

    def utc() -> float:
        return time.time() + later_s

    site = build_site(config.station)
    if site is None:
        raise CommandFailed(NO_PLACE)
    try:
        target = find(words, site, build_catalogue(config))
        target.sight(utc())
        if receiver is not None:
            check(receiver, config)
    except (Unknown, NotThere, BadAddress) as reason:
        raise CommandFailed(str(reason)) from None
    return asyncio.run(
        _run(config, path, chosen, [SKY], plain=plain, target=target, utc=utc, receiver=receiver, svg=svg)
    )


async def _run(
    config: Config,
    path: Path | None,
    faults: list[tuple[float, str]],
    tasks: list[str],
    *,
    plain: bool,
    target: Target | None = None,
    utc: Callable[[], float] = time.time,
    receiver: str | None = None,
    svg: Path | None = None,
) -> int:
    stop = stop_on_signals()
    log_to(logging.StreamHandler())
    # The guide reports faults itself. Log lines between its questions would confuse.
    logging.getLogger().setLevel(logging.CRITICAL)
    screen: PlainLines | LivePicture = PlainLines() if plain else LivePicture()
    on_open = partial(_inject, faults)

    def drawn(shown: Residuals) -> None:
        if svg is not None:
            _draw(shown, svg, screen)

    session = CalibrationSession(
        config, path, screen, open_station, on_open, target=target, utc=utc, receiver=receiver, draw=drawn
    )
    # `rotator stop` finds it from any folder.
    with announced(monitor_path(config.state.path, config.monitor.path, os.environ), path):
        return 0 if await session.run(tasks, stop) else 1


def _draw(shown: Residuals, svg: Path, screen: PlainLines | LivePicture) -> None:
    try:
        write_whole(svg, residual_svg(shown.points, shown.before, shown.after), mode=0o644)
    except OSError as fault:
        screen.show(f"{svg}: cannot be written: {fault.strerror}")
    else:
        screen.show(f"The points are drawn in {svg}.")


def _inject(faults: list[tuple[float, str]], station: Station) -> None:
    """Inject the faults of the option --fault into the simulator."""
    for at_s, name in faults:
        assert station.world is not None, "parse_faults refuses faults on real hardware"
        asyncio.get_running_loop().call_later(at_s, station.world.inject, name)


def _refuse_beside_running_box(config: Config, path: Path | None) -> None:
    """Raises CommandFailed if the box is running: two programs could open the same serial port or I2C chip. With a
    simulated rotor only a box that uses the same sockets and files counts."""
    if config.rotor.hardware == "sim":
        make_sure_of(monitor_path(config.state.path, config.monitor.path, os.environ), path)
        return
    for place in consoles(path):
        if box := connected(place):
            box.close()
            raise CommandFailed(
                "the box is running, or another calibration, and only one program may drive the motors. End it first: "
                "sudo systemctl stop rotator"
            )


def _refuse_stopped(config: Config, path: Path | None) -> None:
    """After a latched stop a person may still be at the mast. So the person at the terminal must confirm that the mast
    is free, which ends the stop. Raises CommandFailed without that confirmation."""
    kept = build_latch_file(config, memory_folder(config.state.path, path, os.environ))
    if (stopped := kept.load()) is None:
        return
    held = spoken(held_by(stopped.by, storm=stopped.storm))
    if not sys.stdin.isatty():
        raise CommandFailed(
            f"{held}: nothing turns in a calibration either. Start it in a terminal: there it asks whether the mast "
            "is free of people, and can end the stop"
        )
    click.echo(wrapped(f"{held}, and nothing turns in a calibration either.", Console()))
    if not click.confirm("Is the mast free of people, and shall the stop end?"):
        raise CommandFailed("the stop stays: nothing was done")
    if not kept.save(None) and not kept.outlives:
        raise CommandFailed("the stop stays: its file cannot be written")
