"""What two parts of one file must not share: a GPIO, a place on a bus, a port; and links that could never work.

Knows pins, chips and links as the tables give them. Each function returns a sentence for each fault.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rotator.config.chips import I2CChip
from rotator.config.links import NEEDS_STATION, Link, is_same_place


def pins_twice(used: Iterable[tuple[int, str]]) -> list[str]:
    """`used`: each GPIO, with the key that names it."""
    users: dict[int, list[str]] = {}
    for pin, key in used:
        users.setdefault(pin, []).append(key)
    return [f"GPIO {pin} is used by {' and '.join(keys)}" for pin, keys in users.items() if len(keys) > 1]


def chips_twice(used: Iterable[I2CChip]) -> list[str]:
    users: dict[tuple[int, int], list[str]] = {}
    for chip in used:
        users.setdefault((chip.bus, chip.address), []).append(chip.key)
    return [
        f"{' and '.join(sorted(keys, reverse=True))} are both 0x{address:02x} on bus {bus}"
        for (bus, address), keys in users.items()
        if len(keys) > 1
    ]


def places_twice(links: Sequence[Link]) -> list[str]:
    users: dict[tuple[str, str | None, str | None], list[int]] = {}
    for number, link in enumerate(links):
        users.setdefault((link.where, link.connect, link.udp), []).append(number)
    return [
        f"{len(numbers)} links use {where}: {' and '.join(f'link[{number}]' for number in numbers)}: "
        "give one of them another place"
        for (where, *_), numbers in users.items()
        if len(numbers) > 1
    ]


def follows_itself(links: Sequence[Link]) -> list[str]:
    return [
        f'link[{number}].connect = "{link.connect}" is the box itself (link[{other}].tcp = "{server.tcp}"): '
        "give one of the two another port"
        for number, link in enumerate(links)
        for other, server in enumerate(links)
        if link.connect and server.tcp and is_same_place(server.tcp, link.connect)
    ]


def needs_station(links: Sequence[Link]) -> list[str]:
    """The links that need the station, where its place is not known."""
    return [
        f"link[{number}]: {link.protocol} needs [station], with latitude_deg and longitude_deg, or locator"
        for number, link in enumerate(links)
        if link.protocol in NEEDS_STATION
    ]
