"""What a person means who types a name, or a part of one, where `rotator config --ask` offers numbers."""

from __future__ import annotations

import re
from ipaddress import IPv4Interface

import pytest

from rotator.setup.machine import Machine
from rotator.setup.questions import questions

MACHINE = Machine(False, ("/dev/serial/by-id/usb-FTDI_A1-if00",), (IPv4Interface("10.0.0.5/25"),), "shack")
ASKED = {each.name: each for each in questions({"rotor": "g5500", "program": "gs232b"}, MACHINE)}


@pytest.mark.parametrize(
    ("question", "typed", "meant"),
    [
        ("rotor", "3", "f1efw"),
        ("rotor", "G-5500", "g5500"),
        ("rotor", "yaesu g5500", "g5500"),
        ("rotor", "5500", "g5500"),
        ("rotor", "u-100", "u100"),
        ("rotor", "Spid", "spid"),
        ("rotor", "moteus", "isel"),
        ("rotor", "PCA9685", "servos"),
        ("rotor", "knob", "orbit360"),
        ("rotor", "SatNOGS v3", "satnogs"),
        ("rotor", "TMC5160", "satnogs"),
        ("rotor", "G-450A", "g450"),
        ("rotor", "Yaesu G-1000DXA", "g1000"),
        ("rotor", "Hy-Gain Ham IV", "ham4"),
        ("hardware", "y", "pi"),
        ("hardware", "no", "sim"),
        ("hardware", "Raspberry", "pi"),
        ("program", "PstRotator", "gs232b"),
        ("program", "gpredict", "rotctld"),
        ("program", "predict", "easycomm2"),
        ("program", "SDR Console", "rotctld"),
        ("program", "SatTrack", "gs232-f1efw"),
        ("program", "gs-232", "gs232b"),
        ("program", "none", "none"),
        ("port", "/dev/ttyUSB1", "/dev/ttyUSB1"),
        ("port", "/dev/serial/by-id/usb-FTDI_A1-if00", "/dev/serial/by-id/usb-FTDI_A1-if00"),
        ("port", "usb cable", "/dev/ttyGS0"),
        ("display", "0X27", "0x27"),
        ("network", "10.0.0.9/25", "10.0.0.0/25"),
        ("network", "10.0.0.1", "10.0.0.1/32"),
        ("network", "192.168.1.0/24", "192.168.1.0/24"),
        ("azimuth", "437,5°", "437.5"),
        ("place", "", ""),
    ],
)
def test_a_number_a_name_or_a_part_of_it(question: str, typed: str, meant: str) -> None:
    assert ASKED[question].answer(typed) == meant


@pytest.mark.parametrize(
    ("question", "typed", "said"),
    [
        ("rotor", "360", '"360" may be 4 or 8: type the number'),
        ("rotor", "pot", '"pot" may be 3 or 8: type the number'),
        ("rotor", "550", '"550" is not known'),
        ("rotor", "99", '"99" is not known'),
        ("rotor", "teapot 9", '"teapot 9" is not known. Type the number of one that measures'),
        ("rotor", "g5500x9", "is not known"),
        ("hardware", "sim9", '"sim9" is not in the list. Type a number from 1 to 2, or a name of the list'),
        ("program", "gs232-f1efw", "is not in the list"),
        ("port", "COM3", "COM3 is the port's name on the PC"),
        ("port", "pty", "or a serial port such as /dev/ttyUSB1"),
        ("display", "i2c", '"i2c" may be 3 or 4'),
        ("network", "here", '"here" is no network: type one such as 192.168.1.0/24'),
        ("azimuth", "all round", '"all round" is no number: type degrees'),
        ("hardware", "-", '"-" is not in the list'),
    ],
)
def test_what_fits_two_answers_or_none_says_what_to_type(question: str, typed: str, said: str) -> None:
    with pytest.raises(ValueError, match=re.escape(said)):
        ASKED[question].answer(typed)


def test_every_line_of_every_list_means_itself() -> None:
    for question in ASKED.values():
        for choice in question.choices:
            assert question.answer(choice.words) == choice.answer
