"""How long the plan of many passes takes: run `python -m benchmarks.schedule`.

Twenty satellites like RS-44, SO-50 and ISS, their orbits spread over the sky, over 24 hours, on five antennas. Prints a
Markdown table: the passes, how many are flown, the share of the time in which the antenna is on a satellite, and the
seconds of CPU from elements to plan.
"""

from __future__ import annotations

import time

from rotator.control.sky.mount import Mount, Range, Sector
from rotator.tracking.planned import Followed
from rotator.tracking.schedule import schedule
from tests.tracking.arcs import EPOCH_S, FULL, OVER, SINGLE, antenna, satellites

HOURS = 24
COUNT = 20
HORIZON = ((0.0, 5.0), (90.0, 12.0), (180.0, 3.0), (270.0, 8.0))
CHIMNEY = Sector("the chimney", Range(100, 130), Range(0, 40), 2.0)
ANTENNAS = {
    "450 × 180": FULL,
    "360 × 90": SINGLE,
    "360 × 180, over the top": OVER,
    "450 × 180, over the top": Mount(Range(0, 450), Range(0, 180), flip=True),
    "450 × 180, trees and a chimney": Mount(Range(0, 450), Range(0, 180), horizon=HORIZON, sectors=(CHIMNEY,)),
}


def main() -> None:
    print("| antenna | passes | flown | of the time | CPU |\n| --- | --- | --- | --- | --- |")
    for name, mount in ANTENNAS.items():
        begun_s = time.process_time()
        followed = [Followed(each, 1.0 + number % 3) for number, each in enumerate(satellites(COUNT))]
        plan = schedule(followed, antenna(mount), EPOCH_S, EPOCH_S + HOURS * 3600)
        spent_s = time.process_time() - begun_s
        flights = [each.flight for each in plan if each.flight]
        busy_s = sum(flight.end_s - flight.begin_s for flight in flights)
        print(f"| {name} | {len(plan)} | {len(flights)} | {busy_s / HOURS / 36:.0f} % | {spent_s:.2f} s |")


if __name__ == "__main__":
    main()
