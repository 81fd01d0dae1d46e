"""The questions of `rotator config --ask`: their words, the offered answers, and which question comes next.

Pure: the answers so far and the machine come in, a question comes out. Does not know the terminal, nor the file.
"""

from __future__ import annotations

import ipaddress
import re
from collections.abc import Callable, Iterator, Mapping

from rotator.config.sky import StationTable
from rotator.setup.machine import Machine
from rotator.setup.question import Choice, Question

Answers = Mapping[str, str]
"""By the name of the question."""


ROTORS = (
    Choice("g5500", "Yaesu G-5500, G-5400 and the like, on their control box"),
    Choice("g450", "azimuth alone, on its control box: Yaesu G-450, G-650 and the like"),
    Choice("f1efw", "another rotor with a pot on each axis, on four relays"),
    Choice("spid", "360° × 180° like a Spid, with pots put in"),
    Choice("u100", "TV rotors that count contacts (Alliance U-100)"),
    Choice("isel", "two moteus controllers (ISEL's rotary axes)"),
    Choice("servos", "two hobby servos on a PCA9685"),
    Choice("orbit360", "control boxes with a knob (ORBIT-360), a digital pot in its place"),
    Choice("slew-drive", "a slew drive or other DC motors: H-bridges, encoders with two channels"),
    Choice("ham4", "azimuth alone, with a wedge brake: Ham IV, T2X and the like"),
    Choice("controller", "a ready-made controller with a serial port or on the network"),
    Choice("tv-rotator", "a TV rotator from which nothing comes back"),
    Choice("satnogs", "two steppers on TMC5160 chips (SatNOGS v3)"),
    Choice("g1000", "azimuth alone, with a speed input: Yaesu G-800, G-1000, G-2800"),
)
"""The shipped configurations for real rotors."""
_SHIPPED = {
    "g5500": (r"(yaesu|kenpro)?[gk]r?s?5[456]00(dc|ac|a|b)?",),
    "g1000": (r"(yaesu|kenpro)?gr?(800|1000|2800)(sdx|dx[ac])?",),
    "g450": (
        r"(yaesu|kenpro)?[gk]r?s?(400|450|500|550|600|650|800|1000|2000|2700|2800)(rc|sdx|dxa|dxc|xl|sa|a|c|dc)?",
    ),
    "ham4": (r"(cde|hygain|cd)?ham(ii|iii|iv|v|[2345m])?|t2x|tailtwister|cd(e|44|45)?(ii)?",),
    "f1efw": (
        r"(cde|hygain)?ar(20|22|30|33|35|40)x?[lx]?l?",
        r"f1efw|arduino|sketch|relays?|pots?|relaypots?|potentiometer",
        r"(create)?rc5\w*|emotator\w*|prosistel\w*|pst\d+\w*|(alliance)?hd73|kr\d+\w*",
    ),
    "u100": (
        r"(alfa|alpha)?spid|(big)?ras(hr|2)?|rak|rau",
        r"(m2)?(orion)?(or|rc)?2800(px|pdc|g)?|orion|m2",
        r"(alliance)?[ut]1[01]0|alliance|ko6th|relaypulses?|pulses?|counter|reed|hall",
    ),
    "tv-rotator": (r"tv\w*|(channelmaster)?95\d\dw?|relaytimed|timed|blind|nofeedback", r"(rca)?vh\d+\w*"),
    "orbit360": (r"orbit(360)?|aa2tx|mcp410\d\d|digitalpot|digipots?",),
    "controller": (
        r"controllers?|gs232[ab]?|erc\w*|k3ng|md0[12]|rot[12]prog|dcu1?|rt21|arco|satnogs|easycomm\w*|hamlib",
    ),
    "isel": (r"isel|mjbots|moteus\w*|canfd",),
    "slew-drive": (
        r"se\d+[a-z]?|wds?e\d*|slew(ing)?(drive)?s?|hbridges?|dcmotors?|quadrature|l298n?|vnh\w*|tb6612\w*",
    ),
    "satnogs": (r"satnogs(v?3\w*)?|(tmc)?51[36]0\w*|steppers?|nema\d*",),
    "servos": (r"(sg|mg|ds|hs)\d+\w*|hobbyservos?|servos|pca9685",),
}
"""By shipped file: what radio amateurs call their rotors, in small letters without spaces and signs. The first that
fits counts."""
TURNS: Mapping[str, tuple[str, ...]] = {
    "g5500": ("450", "180"),
    "g450": ("450",),
    "g1000": ("450",),
    "ham4": ("360",),
    "f1efw": ("360", "90"),
    "spid": ("360", "180"),
    "u100": ("360", "180"),
    "tv-rotator": ("360",),
}
"""Of the rotors on relays: the degrees of azimuth, and of elevation where they have it."""

NETWORK_PROGRAM, NONE_YET = "rotctld", "none"
PROGRAMS = (
    Choice("rotctld", "Gpredict, SDR Console, Look4Sat, Hamlib: by network (rotctld)"),
    Choice("gs232b", "PstRotator, SatPC32, OscarWatch, SDRangel, Termite: GS-232"),
    Choice("gs232-f1efw", "SatTrack, Orbitron, or what steered the Arduino: W orders"),
    Choice("easycomm2", "predict and others: EasyComm II"),
    Choice("macdoppler", "MacDoppler, by UDP"),
    Choice("n1mm", "N1MM Logger+, by UDP"),
    Choice(NONE_YET, "none yet"),
)
"""By the protocol of each group of programs."""
UDP = {"macdoppler": "0.0.0.0:9932", "n1mm": "0.0.0.0:12040"}
USB_CABLE, ON_THIS_MACHINE = "/dev/ttyGS0", "pty"


def questions(answers: Answers, machine: Machine) -> Iterator[Question]:
    """All questions that these answers lead to, in their order; later ones depend on earlier answers."""
    yield Question(
        "rotor", "Which rotor?", "The file begins as the shipped one of this rotor. `rotator help wiring` shows each.",
        "g5500", ROTORS, _rotor,
    )  # fmt: skip
    yield Question(
        "hardware", "Is the rotor wired to this machine?",
        'A simulated one shows the whole box without hardware: hardware = "pi" in the file changes it later.',
        "pi" if machine.is_pi else "sim",
        (Choice("sim", "not yet: simulate it"), Choice("pi", "yes, this is the Raspberry Pi")),
    )  # fmt: skip
    rotor = answers.get("rotor", "")
    if rotor in TURNS:
        azimuth, *elevation = TURNS[rotor]
        yield Question(
            "azimuth", "How many degrees does azimuth turn, from stop to stop?",
            "360, or 450 for a rotor with overlap. The box never turns beyond.", azimuth, (), _degrees(90, 720, "360"),
        )  # fmt: skip
        if elevation:
            yield Question(
                "elevation", "How many degrees does elevation turn?",
                "90, or 180 for a rotor that goes over the top.", elevation[0], (), _degrees(20, 200, "90"),
            )  # fmt: skip
    yield Question(
        "program", "Which program turns the antenna?",
        "One is enough to begin; a [[link]] more for each other. `rotator help programs` lists them all.",
        NETWORK_PROGRAM, PROGRAMS,
    )  # fmt: skip
    if answers.get("program") not in (NETWORK_PROGRAM, NONE_YET, *UDP, None):
        yield _port(answers, machine)
    yield Question(
        "display", "A 16×2 display on the box?", "It shows where the satellite and the antenna are.",
        "none",
        (
            Choice("none", "none"),
            Choice("gpio", "on six lines of the Pi"),
            Choice("0x27", "with an I2C backpack, address 0x27"),
            Choice("0x3f", "with an I2C backpack, address 0x3f"),
        ),
    )  # fmt: skip
    yield _network(machine)
    yield Question(
        "place", "Where does the antenna stand?",
        "A locator such as JN18du, or latitude and longitude such as 48,85 2,35 (south and west with a minus). "
        "Only some programs need it: else leave it empty.", "", (), place,
    )  # fmt: skip


def _port(answers: Answers, machine: Machine) -> Question:
    adapters = tuple(Choice(port, f"the adapter {port}") for port in machine.ports)
    return Question(
        "port", "How is the PC with this program connected?",
        "The Pi can be a COM port of the PC: `sudo rotator setup usb-serial` makes it one.",
        adapters[0].answer if adapters else USB_CABLE if answers.get("hardware") == "pi" else ON_THIS_MACHINE,
        (
            Choice(USB_CABLE, "a USB cable from the PC to the Pi"),
            *(adapters or (Choice("/dev/ttyUSB0", "a USB serial adapter in this machine"),)),
            Choice(ON_THIS_MACHINE, "not at all: it runs on this machine"),
            Choice("0.0.0.0:4534", "by network, TCP port 4534"),
        ),
        _serial_port,
    )  # fmt: skip


def _network(machine: Machine) -> Question:
    return Question(
        "network", "Which computers may reach the box over the network (rotctld, port 4533)?",
        "There is no password: every program that reaches it turns the antenna. A network is written 192.168.1.0/24.",
        "here",
        (
            Choice("here", "only programs on this machine"),
            *(Choice(network, f"this machine and those of {network}") for network in machine.networks),
        ),
        network,
    )  # fmt: skip


def _rotor(name: str) -> str:
    """The shipped configuration for a rotor's name on its box, such as G-450. Raises ValueError."""
    for bare in (re.sub(r"[^a-z0-9]", "", word) for word in (name.lower(), *name.lower().split())):
        for profile, patterns in _SHIPPED.items():
            if any(re.fullmatch(pattern, bare) for pattern in patterns):
                return profile
    raise ValueError(f'"{name}" is not known. Type the number of one that measures its angle in the same way')


def _serial_port(text: str) -> str:
    if re.fullmatch(r"/dev/[\w./:-]+", text):
        return text
    if re.fullmatch(r"com\d+:?", text, re.IGNORECASE):
        raise ValueError(f"{text.upper()} is the port's name on the PC. Type the number of the cable to the PC")
    raise ValueError(f'"{text}" is not in the list. Type its number, or a serial port such as /dev/ttyUSB1')


def network(text: str) -> str:
    """`192.168.1.5/24` as its network. Raises ValueError."""
    bare = text.strip()
    try:
        found = ipaddress.ip_network(bare, strict=False)
    except ValueError:
        raise ValueError(f'"{bare}" is no network: type one such as 192.168.1.0/24') from None
    if found.version != 4:
        raise ValueError(f'"{bare}" is IPv6, and the box listens on IPv4: type one such as 192.168.1.0/24')
    if "/" not in bare and bare.rpartition(".")[2] in ("0", "255"):
        whole = ipaddress.ip_network(f"{bare}/24", strict=False)
        raise ValueError(f'"{bare}" is the address of no computer: did you mean {whole}?')
    return str(found)


def place(text: str) -> str:
    """A locator, or `latitude longitude` with points; empty for none. Raises ValueError."""
    bare = text.strip().replace("°", " ").replace("−", "-")
    if not bare:
        return ""
    if re.fullmatch(r"[A-Za-z]{2}\d{2}.*", bare):
        try:
            StationTable(locator=bare)
        except ValueError:
            raise ValueError(f'"{bare}" is no locator of 6 to 12 characters, such as JN18du') from None
        return bare
    found = re.fullmatch(
        r"([NS]?)\s*([-+]?\d+(?:[.,]\d+)?)\s*([NS]?)(?:\s*[;/]\s*|\s*,\s+|\s+|(?<=[.]\d),|,)\s*"
        r"([EW]?)\s*([-+]?\d+(?:[.,]\d+)?)\s*([EW]?)",
        bare.upper(),
    )
    # "48,85" and "48,85,2,35" may be cut in several ways.
    unclear = "," in bare and not re.search(r"[\s;/.]", bare)
    if not found or unclear:
        raise ValueError("type a locator such as JN18du, or two numbers with a space between them: 48.85 2.35")
    latitude, longitude = (float(number.replace(",", ".")) for number in (found[2], found[5]))
    latitude = -latitude if "S" in found[1] + found[3] else latitude
    longitude = -longitude if "W" in found[4] + found[6] else longitude
    if abs(latitude) > 90 or abs(longitude) > 180:
        raise ValueError("latitude goes from -90 to 90, longitude from -180 to 180: latitude comes first")
    return f"{round(latitude, 6):.10g} {round(longitude, 6):.10g}"


def _degrees(least: float, most: float, usual: str) -> Callable[[str], str]:
    def understood(text: str) -> str:
        bare = re.sub(r"\s*(?:°|deg(?:rees)?)\s*$", "", text.strip()).replace(",", ".")
        try:
            angle_deg = float(bare)
        except ValueError:
            raise ValueError(
                f'"{text.strip()}" is no number: type degrees from {least:g} to {most:g}, such as {usual}'
            ) from None
        if not least <= angle_deg <= most:
            raise ValueError(f"{angle_deg:g}° cannot be: from {least:g} to {most:g}")
        return f"{angle_deg:g}"

    return understood
