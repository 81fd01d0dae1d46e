"""`rotor.type = "controller"`: a ready-made controller with a serial port or on the network, or one for each axis.

Knows its table [controller], and the answers of this kind to the questions in `kind.py`. Knows no driver.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import ClassVar, Literal

from pydantic import Field

from hw.ports import AngleSource, Axis
from rotator.config.axes import AxisTable
from rotator.config.kinds.kind import Kind, Usual
from rotator.config.links import address
from rotator.config.sensors import Angle
from rotator.config.table import Table

Spoken = Literal["rotctld", "gs232a", "gs232b", "easycomm2", "easycomm3", "rot2prog", "md01", "rot1prog", "dcu1"]
FULL_TURN_DEG = 360.0


@dataclass(frozen=True, slots=True)
class Language:
    """What there is to know of a protocol before it is spoken."""

    step_deg: float = 1.0
    """It tells and takes angles in steps of this. A rotctld says hundredths; the rotor behind it mostly has degrees."""
    order_deg: float = 1.0
    """The steps in which it can be ordered."""
    baud: int = 9600
    azimuth_only: bool = False
    low_deg: float = 0.0
    """It cannot be told a lower angle."""


LANGUAGES: Mapping[Spoken, Language] = {
    "rotctld": Language(order_deg=0.01, low_deg=-180.0),
    "gs232a": Language(),
    "gs232b": Language(),
    "easycomm2": Language(0.1, 0.1, low_deg=-360.0),
    "easycomm3": Language(0.1, 0.1, low_deg=-360.0),
    "rot2prog": Language(0.5, 0.5, 600, low_deg=-360.0),
    "md01": Language(0.1, 0.1, low_deg=-360.0),
    "rot1prog": Language(baud=1200, azimuth_only=True, low_deg=-360.0),
    "dcu1": Language(baud=4800, azimuth_only=True),
}


class ControllerBox(Table):
    protocol: Spoken = "gs232b"
    """What it speaks."""
    serial: str | None = Field(None, min_length=1)
    """Its serial port, or a URL of pyserial such as rfc2217://192.168.1.20:4000."""
    tcp: str | None = None
    """In place of `serial`: the address where it listens, such as 127.0.0.1:4533."""
    baud: int | None = Field(None, ge=50, le=4_000_000)
    """Left out: 600 for rot2prog, 1200 for rot1prog, 4800 for dcu1, else 9600."""
    counts_from_deg: float | None = Field(None, ge=-360, le=360)
    """It tells azimuths of one turn only, from this angle up: 0 or -180. Left out: those of the axis, 0 to 450 say."""

    @property
    def language(self) -> Language:
        return LANGUAGES[self.protocol]

    @property
    def rate(self) -> int:
        """In baud."""
        return self.baud or self.language.baud

    def faults(self) -> Iterator[str]:
        if self.serial and self.tcp:
            yield "serial and tcp are both given: a controller is at one of them"
        if self.tcp:
            try:
                address(self.tcp)
            except ValueError as fault:
                yield f"tcp: {fault}"


class Controller(ControllerBox):
    target_every_s: float = Field(1.0, ge=0.1, le=10)
    """It gets a new target no oftener than this. A stop goes out at once."""
    ask_every_s: float = Field(0.1, ge=0.05, le=1)
    """It is asked for its angle no oftener than this."""
    answer_s: float = Field(0.8, ge=0.05, le=1.5)
    """Its answer takes no longer than this."""
    dead_band_deg: float = Field(1.0, ge=0, le=20)
    """How far from its target it may come to rest, beside its own steps."""
    azimuth: ControllerBox | None = None
    """The azimuth's own controller, where each axis has one."""
    elevation: ControllerBox | None = None
    """The elevation's own controller. One that knows azimuths only is told the elevation as one."""

    def boxes(self, axes: Iterable[Axis]) -> dict[tuple[Axis, ...], ControllerBox]:
        """Each controller, by the axes that it turns."""
        own = {axis: box for axis in axes if (box := self.azimuth if axis is Axis.AZIMUTH else self.elevation)}
        boxes: dict[tuple[Axis, ...], ControllerBox] = {(axis,): box for axis, box in own.items()}
        shared = tuple(axis for axis in axes if axis not in own)
        return ({shared: self} if shared else {}) | boxes

    def box(self, axis: Axis) -> ControllerBox:
        return (self.azimuth if axis is Axis.AZIMUTH else self.elevation) or self


@dataclass(frozen=True, slots=True)
class ControllerKind(Kind):
    controller: Controller
    simulated: bool

    own = Angle(AngleSource.MEASURED, sensor="controller", by="told by its controller")
    usual: ClassVar[Usual] = {axis: {"tolerance_deg": 1.0} for axis in ("azimuth", "elevation")}
    holds = "the controller goes on to its last target, and stands there; its own stop would end that"

    def serial_port(self) -> str | None:
        ports = (box.serial or "://" for box in self.controller.boxes(Axis).values())
        return next((port for port in ports if "://" not in port), None)

    def faults(self, axes: Mapping[Axis, AxisTable]) -> Iterator[str]:
        for turned, box in self.controller.boxes(axes).items():
            key = "controller" if box is self.controller else f"controller.{turned[0].value}"
            if len(turned) > 1 and box.language.azimuth_only:
                yield f"{box.protocol} turns an azimuth only: give the elevation its own table [controller.elevation]"
            if not (self.simulated or box.serial or box.tcp):
                yield f"{key} has neither serial nor tcp: say where the controller is"
            for axis in turned:
                yield from _range(key, box, axis, axes[axis])

    def slack_deg(self, axis: Axis) -> float:
        """Its own dead band, half a step of the order and of the answer each, and what is not worth a new target."""
        language = self.controller.box(axis).language
        return self.controller.dead_band_deg + language.step_deg

    def reversal_rest_s(self, axis: Axis) -> float:
        """It gets its new target once it has been seen to stand, and no oftener than it bears."""
        return self.controller.target_every_s + self.controller.ask_every_s

    def reversal(self, axis: Axis) -> str:
        return f"turn the {axis.value}'s direction round in the controller's own menu, or swap its motor's wires"


def _range(key: str, box: ControllerBox, axis: Axis, limits: AxisTable) -> Iterator[str]:
    """An axis that its controller cannot be told of."""
    if box.counts_from_deg is not None and axis is Axis.AZIMUTH:
        if limits.max_deg - limits.min_deg > FULL_TURN_DEG:
            yield (
                f"{key}.counts_from_deg: it tells one turn only, so nobody knows on which turn an antenna with an "
                f"overlap is: azimuth's min_deg {limits.min_deg:g} to max_deg {limits.max_deg:g} may be 360 at most"
            )
    elif limits.min_deg < box.language.low_deg:
        yield (
            f"{axis.value}.min_deg = {limits.min_deg:g}: {box.protocol} has no angle below {box.language.low_deg:g}; "
            f"where it counts one turn only, say from where: {key}.counts_from_deg"
        )
