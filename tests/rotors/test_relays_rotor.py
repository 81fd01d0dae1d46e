"""Motors on relays as the control loop sees them: directions, the supply, and a guard in the clock's own time."""

from __future__ import annotations

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.clock import SimClock
from hw.buses.gpio import GpioOutputs
from hw.drives.relays import RelayBank
from hw.ports import Axis, Direction
from rotator.control.commands import Feed, Run, Unfed
from rotator.rotors.relays import RelayRotor

MINUS, OFF, PLUS = Direction
AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
PINS = {"azimuth_cw": 22, "azimuth_ccw": 23, "elevation_up": 24, "elevation_down": 25, "master": 26}


class Bench:
    def __init__(self, *, master: bool = True) -> None:
        self.clock, self.gpio = SimClock(50.0), SimGpio(SimClock())
        pins = PINS if master else {name: pin for name, pin in PINS.items() if name != "master"}
        lines = GpioOutputs(self.gpio, "/dev/gpiochip0", pins, consumer="test")
        bank = RelayBank(lines, self.clock, dead_time_s=0.5, master=master)
        self.rotor = RelayRotor(bank, {}, lambda axis: frozenset({PLUS} if axis is EL else ()))
        self.rotor.begin(self.clock.add_alarm)

    def run(self, axis: Axis, way: Direction) -> Direction:
        return self.rotor.obey(axis, Run(way, self.clock() + 0.25))

    def on(self) -> set[str]:
        return {name for name, pin in PINS.items() if self.gpio.level(pin)}


def test_the_supply_is_on_for_a_look_and_off_when_it_shall_turn_nothing() -> None:
    bench = Bench()
    assert not bench.rotor.condition(EL).supplied
    assert bench.rotor.obey(AZ, Feed(bench.clock() + 0.25)) is OFF
    assert bench.on() == {"master"}
    assert bench.rotor.condition(EL).supplied
    bench.clock.sleep(0.25)
    assert bench.on() == set()
    bench.run(AZ, PLUS)
    assert bench.rotor.driven(AZ) is PLUS
    assert bench.rotor.obey(AZ, Unfed()) is OFF
    assert bench.on() == set(), "it does not linger"
    assert bench.rotor.driven(AZ) is OFF
    assert not bench.rotor.condition(AZ).supplied
