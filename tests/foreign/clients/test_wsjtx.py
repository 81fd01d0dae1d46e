"""WSJT-X itself, on a virtual screen: its Astronomical Data window writes azel.dat, and the antenna follows the Sun.

The station is put where the Sun stands well up at this hour. Where the Sun is, the test calculates itself.
"""

from __future__ import annotations

import math
import os
import signal
import subprocess
from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path

from rotator.orbits.locator import from_locator, to_locator
from tests.gpredict.sky import Station, apart_deg
from tests.gpredict.window import screen
from tests.machines.shack import Shack

NEAR_DEG = 4.6 + 0.4
"""The box's tolerance; the test's Sun and the size of a square of the locator."""
J2000 = datetime(2000, 1, 1, 12, tzinfo=UTC)


def sun(station: Station, moment: datetime) -> tuple[float, float]:
    """Azimuth and elevation of the Sun's middle in degrees, right to a few hundredths. Source: the Astronomical
    Almanac's formulas of low precision."""
    days = (moment - J2000).total_seconds() / 86400
    anomaly = math.radians(357.528 + 0.9856003 * days)
    ecliptic = math.radians(280.460 + 0.9856474 * days + 1.915 * math.sin(anomaly) + 0.020 * math.sin(2 * anomaly))
    tilt = math.radians(23.439 - 4e-7 * days)
    ascension = math.atan2(math.cos(tilt) * math.sin(ecliptic), math.cos(ecliptic))
    declination = math.asin(math.sin(tilt) * math.sin(ecliptic))
    sidereal = math.radians(280.46062 + 360.98564737 * days + station.longitude_deg)
    hour, here = sidereal - ascension, math.radians(station.latitude_deg)
    up = math.sin(here) * math.sin(declination) + math.cos(here) * math.cos(declination) * math.cos(hour)
    east = -math.cos(declination) * math.sin(hour)
    north = math.cos(here) * math.sin(declination) - math.sin(here) * math.cos(declination) * math.cos(hour)
    return math.degrees(math.atan2(east, north)) % 360, math.degrees(math.asin(up))


def morning(moment: datetime) -> tuple[str, Station]:
    """A locator at 40° north where it is nine o'clock by the Sun, and the middle of its square."""
    hour = moment.hour + moment.minute / 60
    locator = to_locator((15 * (9 - hour) + 180) % 360 - 180, 40.0, 3)
    longitude_deg, latitude_deg = from_locator(locator)
    return locator, Station(latitude_deg, longitude_deg)


def test_the_antenna_follows_its_sun(
    box_with: Callable[..., Shack], need_program: Callable[[str, str], str], tmp_path: Path
) -> None:
    program = need_program("wsjtx", "wsjtx")
    need_program("Xvfb", "xvfb")
    locator, station = morning(datetime.now(UTC))
    home = {name: tmp_path / name for name in ("XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_RUNTIME_DIR")}
    for folder in home.values():
        folder.mkdir(mode=0o700)
    (home["XDG_CONFIG_HOME"] / "WSJT-X.ini").write_text(
        f"[MainWindow]\nAstroDisplayed=true\n[Configuration]\nMyCall=N0CALL\nMyGrid={locator}\n", encoding="ascii"
    )
    file = home["XDG_DATA_HOME"] / "WSJT-X" / "azel.dat"
    box = box_with({"protocol": "wsjtx", "file": str(file), "body": "Sun"})
    assert box.stands() == (0.0, 0.0)

    with screen() as desk, (tmp_path / "wsjtx.log").open("wb") as log:
        environment = {**desk.environment, **{name: str(path) for name, path in home.items()}, "HOME": str(tmp_path)}
        client = subprocess.Popen(
            [program], env=environment, cwd=tmp_path, stdout=log, stderr=log, start_new_session=True
        )
        try:

            def off_deg() -> float:
                assert client.poll() is None, (tmp_path / "wsjtx.log").read_text()[-2000:]
                return apart_deg(box.world().antenna_deg, sun(station, datetime.now(UTC)))

            box.until(lambda world: off_deg() < NEAR_DEG and world.drives == (0, 0), "it comes to the Sun")
        finally:
            os.killpg(client.pid, signal.SIGKILL)  # with its decoder, a process of its own
            client.wait()
    stood = box.stands()
    assert apart_deg(stood, sun(station, datetime.now(UTC))) < NEAR_DEG
    box.stop()
    assert box.faults() == []
