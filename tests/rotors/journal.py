"""A drive for tests of the rotors' own code: it writes down each command in words. Knows no motor."""

from __future__ import annotations

from hw.ports import AngleSource, Axis, HardwareError


class Journal:
    """A positioned drive with one command that may expire, in words."""

    angle_source = AngleSource.MODELLED

    def __init__(self) -> None:
        self.said: list[str] = []
        self.until_s: float | None = None
        self.broken = False
        self.models: dict[Axis, float] = {}
        self.assumed: set[Axis] = set()
        """The axes whose angle is not known yet."""
        self.wrong: dict[Axis, str] = {}
        self.barred = False
        self.turned_deg: dict[Axis, float] = {}
        self.sensors: set[Axis] = set()
        self.blind_s = 0.0
        """How long a sensor has shown no place since the start."""

    def aim(self, axis: Axis, angle_deg: float, rate_dps: float, until_s: float) -> None:
        self.said.append(f"{axis.value} {angle_deg:g} at {rate_dps:g} until {until_s:g}")
        self.until_s = until_s

    def hold(self, axis: Axis) -> None:
        self.said.append(f"{axis.value} hold")

    def release(self) -> None:
        self.said.append("release")

    def off(self) -> None:
        self.said.append("off")
        if self.broken:
            raise HardwareError("the board does not answer")

    def due_s(self) -> float | None:
        return self.until_s

    def enforce(self, now_s: float) -> None:
        if self.until_s is not None and now_s >= self.until_s:
            self.said.append(f"expired at {now_s:g}")
            self.until_s = None

    def wait_until_due(self, patience_s: float) -> None:
        raise AssertionError("no thread in simulated time")

    def angle_deg(self, axis: Axis) -> float:
        return self.models[axis]

    def position_known(self, axis: Axis) -> bool:
        return axis not in self.assumed

    def faults(self) -> dict[Axis, str]:
        return self.wrong

    def astray_deg(self, axis: Axis) -> float:
        return self.turned_deg.get(axis, 0.0)

    def cut(self) -> bool:
        self.said.append("cut")
        return True

    def restore(self) -> None:
        self.said.append("restore")

    def finish(self) -> None:
        self.said.append("finish")

    def measured(self, axis: Axis) -> None:
        self.sensors.add(axis)

    def unseen_s(self) -> float:
        return self.blind_s

    def found(self, axis: Axis, angle_deg: float) -> None:
        self.models[axis] = angle_deg
