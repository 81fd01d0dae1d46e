"""The configuration file that the answers of `rotator config --ask` make: a shipped one, changed, and commented.

Works on texts. Does not know the dialogue, nor where the file goes.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from rotator.config.keys import describe, tables
from rotator.config.load import shipped
from rotator.config.statements import statements
from rotator.setup.network import allowed
from rotator.setup.questions import NETWORK_PROGRAM, NONE_YET, ON_THIS_MACHINE, TURNS, UDP, USB_CABLE

_COLUMN = 30
"""Where a remark begins behind a short line."""
_WIDTH = 110
_SIM_STATE = 'path = "run/state.json"       # "/var/lib/rotator/state.json" on a Pi, where the service runs'
_SIM_HARDWARE = (
    'hardware = "sim"              # "pi" when the rotor is wired to this Pi; then take the # from the lines on pots'
)
_REAL_POTS = re.compile(r"^((?:calibration|lowest_reading|highest_reading|supply_v|reference_channel) = .*)", re.M)
"""What is true of the real pots only: the simulated ones have readings of their own."""
_LCD = {
    "none": 'kind = "none"                 # "gpio" for one on six lines, "pcf8574" for an I2C backpack',
    "gpio": 'kind = "gpio"                 # on six lines: rotator help wiring; "pcf8574" for an I2C backpack',
}


def for_the_service(text: str) -> str:
    """With the places that the installed service has."""
    return text.replace('pty = "run/', 'pty = "/run/rotator/').replace(
        _SIM_STATE, 'path = "/var/lib/rotator/state.json"'
    )


def new_file(answers: Mapping[str, str]) -> str:
    """The text of the file. Every question has its answer."""
    text = shipped(answers["rotor"])
    body = re.split(r"^\[lcd\]|^\[\[link\]\]", text, maxsplit=1, flags=re.M)[0]
    for axis in ("azimuth", "elevation"):
        if axis in answers and answers[axis] != TURNS[answers["rotor"]][axis == "elevation"]:
            body = re.sub(
                rf"(^\[{axis}\]$.*?^max_deg = ).*?$", rf"\g<1>{answers[axis]}", body, count=1, flags=re.M | re.S
            )
    if answers["hardware"] == "sim":
        body = re.sub(r"^hardware = .*", _SIM_HARDWARE, body, flags=re.M)
        body = re.sub(r"^path = .*", _SIM_STATE, body, flags=re.M)
        body = _REAL_POTS.sub(r"# \1", body)
    parts = [body.rstrip("\n"), _display(answers["display"]), _station(answers["place"]), *_links(answers)]
    return _commented("\n\n".join(part for part in parts if part) + "\n")


def _display(answer: str) -> str:
    kind = _LCD.get(answer)
    rows = [kind] if kind else ['kind = "pcf8574"              # on an I2C backpack', f"address = {answer}"]
    return "\n".join(["[lcd]", *rows])


def _station(answer: str) -> str:
    match answer.split():
        case []:
            return ""
        case [locator]:
            return f'[station]\nlocator = "{locator}"'
        case [latitude, longitude]:
            return f"[station]\nlatitude_deg = {latitude}\nlongitude_deg = {longitude}"
        case _:
            raise ValueError(f"{answer}: no place")


def _links(answers: Mapping[str, str]) -> list[str]:
    program = answers["program"]
    made = []
    if program in UDP:
        made.append(_link("the program; datagrams from any computer", program, f'udp = "{UDP[program]}"'))
    elif program not in (NETWORK_PROGRAM, NONE_YET):
        made.append(_program(program, answers["port"]))
    whose, rows = "Gpredict, Look4Sat, rotctl -m 2, on this machine only", ['tcp = "127.0.0.1:4533"']
    if answers["network"] != "here":
        whose = "Gpredict, Look4Sat, rotctl -m 2, on the network"
        rows = ['tcp = "0.0.0.0:4533"', allowed(answers["network"])]
    return [*made, _link(whose, "rotctld", *rows)]


def _program(protocol: str, port: str) -> str:
    match port:
        case "/dev/ttyGS0":
            return _link("the PC, over USB: `sudo rotator setup usb-serial`", protocol, f'serial = "{USB_CABLE}"')
        case _ if port == ON_THIS_MACHINE:
            return _link("a program on this machine opens this port", protocol, 'pty = "run/gs232"')
        case _ if port.startswith("/"):
            return _link("the PC, over a serial adapter", protocol, f'serial = "{port}"', "baud = 9600")
        case _:
            return _link("the PC, over the network", protocol, f'tcp = "{port}"')


def _link(whose: str, protocol: str, *rows: str) -> str:
    return "\n".join([f"{'[[link]]':<{_COLUMN}}# {whose}", f'protocol = "{protocol}"', *rows])


def _commented(text: str) -> str:
    """Each key without a remark gets the first sentence of its meaning."""
    describe()
    rows = text.split("\n")
    table: list[str] = []
    found = []
    for statement in statements(text):
        names = [part for part in statement.place if isinstance(part, str)]
        if statement.heads:
            table = names
        elif statement.line == statement.last and "#" not in rows[statement.line - 1]:
            field = tables()[".".join(table)].model.model_fields.get(names[len(table)])
            if field and field.description:
                found.append((statement.line - 1, _first_sentence(field.description)))
    for at, remark in reversed(found):
        if len(rows[at].rstrip()) < _COLUMN and _COLUMN + len(remark) < _WIDTH:
            rows[at] = f"{rows[at]:<{_COLUMN}}# {remark}"
        else:
            rows.insert(at, f"# {remark}")
    return "\n".join(rows)


def _first_sentence(text: str) -> str:
    """In small letters, without the full stop: `addresses of the machines that may connect`."""
    sentence = re.split(r"(?<=[a-z0-9`)\]])[.;] ", text)[0].rstrip(".")
    return sentence[0].lower() + sentence[1:] if sentence[1:2].islower() else sentence
