"""The heartbeat line: a change of level at every beat, and at no other time."""

from __future__ import annotations

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.clock import SimClock
from hw.buses.gpio import GpioOutputs
from hw.drives.relays import RelayBank
from hw.safety.heartbeat import HEARTBEAT, Heartbeat

CHIP = "/dev/gpiochip0"
PINS = {"azimuth_cw": 22, "azimuth_ccw": 23, "elevation_up": 24, "elevation_down": 25}
PIN = 26


def test_every_beat_is_one_edge() -> None:
    gpio = SimGpio(SimClock())
    heartbeat = Heartbeat(GpioOutputs(gpio, CHIP, {HEARTBEAT: PIN}, consumer="test"))
    levels = []
    for _ in range(4):
        heartbeat.beat()
        levels.append(gpio.level(PIN))
    assert levels == [True, False, True, False]


def test_the_relays_and_the_heartbeat_leave_each_other_alone() -> None:
    gpio = SimGpio(SimClock())
    lines = GpioOutputs(gpio, CHIP, {**PINS, HEARTBEAT: PIN}, consumer="test")
    bank = RelayBank(lines, SimClock(), dead_time_s=0.5)
    Heartbeat(lines).beat()
    bank.off()
    assert gpio.level(PIN)
