"""The kernel's PWM by its files, on those of a simulated Pi: each is written as the kernel takes it."""

from __future__ import annotations

import errno

import pytest

from firmware_sim.buses.pwm import CHIP, SimPwm
from hw.buses.pwm import KernelPwm
from hw.ports import HardwareError


class Recorded(SimPwm):
    """Refuses the first writes of `file` with this error."""

    def __init__(self, refused: int = 0, file: str = "", number: int = errno.EACCES) -> None:
        super().__init__()
        self.written: list[tuple[str, str]] = []
        self._refused, self._file, self._number = refused, file, number

    def write(self, path: str, text: str) -> None:
        if self._refused and path.endswith(self._file):
            self._refused -= 1
            raise OSError(self._number, "refused")
        super().write(path, text)
        self.written.append((path.removeprefix(f"{CHIP}/"), text))


def at_18(files: SimPwm, slept: list[float] | None = None, hz: float = 20_000.0) -> KernelPwm:
    return KernelPwm(files, 18, hz, (slept if slept is not None else []).append)


def test_a_channel_begins_at_20_khz_without_a_pulse_and_takes_a_quarter() -> None:
    files = Recorded()
    pwm = at_18(files)
    assert files.written[0] == ("export", "0")
    assert files.written[-3:] == [("pwm0/period", "50000"), ("pwm0/duty_cycle", "0"), ("pwm0/enable", "1")]
    pwm.duty(0.25)
    pwm.duty(0.25)
    assert files.written[-2:] == [("pwm0/enable", "1"), ("pwm0/duty_cycle", "12500")]
    assert files.channels[0].share == 0.25
    pwm.close()
    assert files.channels[0].share == 0.0
    assert not files.channels[0].enabled


def test_what_a_killed_program_left_running_is_ended_before_it_is_used() -> None:
    files = SimPwm()
    at_18(files, hz=1000.0).duty(0.9)
    assert files.channels[0].share == 0.9
    pwm = at_18(files)  # exported already, and its duty of 900 µs is longer than the new period of 50
    assert files.channels[0].share == 0.0
    pwm.duty(1.0)
    assert files.channels[0].share == 1.0


def test_udev_gives_the_channel_to_the_group_only_after_a_moment() -> None:
    slept: list[float] = []
    at_18(Recorded(3, "pwm0/enable"), slept)
    assert sum(slept) == pytest.approx(0.15)


@pytest.mark.parametrize(
    ("files", "gpio", "said"),
    [
        (Recorded(10**6, "pwm0/period"), 18, "PWM on GPIO18: no permission: add the user to the group gpio"),
        (Recorded(1, "export", errno.ENODEV), 18, "PWM on GPIO18: the kernel does not take it: refused"),
        (SimPwm(), 17, "PWM on GPIO17: the kernel's PWM is not at that pin: take 18 and 19"),
    ],
)
def test_what_is_wrong_is_said_in_a_sentence(files: SimPwm, gpio: int, said: str) -> None:
    with pytest.raises(HardwareError, match=said):
        KernelPwm(files, gpio, 20_000.0, lambda _seconds: None)


def test_a_pi_without_its_overlay_and_the_fans_chip_of_a_pi_5() -> None:
    class Other(SimPwm):
        device = "/sys/devices/platform/axi/1000120000.pcie/1f0009c000.pwm"

        def target(self, path: str) -> str:
            return self.device

        def read(self, path: str) -> str:
            return "4\n"

    files = Other()
    with pytest.raises(HardwareError, match="this Pi has none at its header: add dtoverlay=pwm-2chan"):
        at_18(files)
    files.device = "/sys/devices/platform/axi/1000120000.pcie/1f00098000.pwm"
    with pytest.raises(HardwareError, match="the kernel does not take it"):
        at_18(files)  # channel 2 of a Pi 5; the simulated chip has two
