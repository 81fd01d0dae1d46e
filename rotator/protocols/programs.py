"""The programs that turn antennas: which protocol each wants, what to set in it, what it sends, and how we know.

Knows facts about other people's programs; what they send is for the tests. Does not know what their words do: the
protocols' own sessions are asked.
"""

from __future__ import annotations

from dataclasses import dataclass

VERIFIED = "**verified**"
"""The real program was run against this box."""


@dataclass(frozen=True, slots=True)
class Program:
    name: str
    protocols: tuple[str, ...]
    where: str
    """Which kind of link, in words; empty: any that the protocol has."""
    settings: str
    says: tuple[bytes, ...]
    """The bytes that the program is known to send; the tests see that the box understands each."""
    known: str
    keys: tuple[tuple[str, int], ...] = ()
    """What else the link must have."""


PROGRAMS = (
    Program(
        "Hamlib `rotctl`, `rotctld`",
        (
            *("gs232b", "gs232a", "rotctld", "easycomm2", "rot2prog", "md01", "dcu1"),
            *("prosistel-d", "prosistel-c", "rc2800", "lx200"),
        ),
        "",
        "the model that goes with the protocol: [see below](#hamlib-in-one-line)",
        (b"W235 025\r", b"C2\r", b"S\r"),
        VERIFIED,
    ),
    Program(
        "Gpredict",
        ("rotctld",),
        "TCP",
        "host, port 4533; Az type 0 → 180 → 360; Max El 90, unless your rotor goes over the top: "
        "[its page](../paths/gpredict.md)",
        (b"p\n", b"P 174.46 12.00\n", b"P 174,46 12,00\n", b"S\n"),
        VERIFIED,
    ),
    Program(
        "PstRotator",
        ("gs232b", "gs232a"),
        "serial or TCP",
        "Yaesu GS-232 with the same letter, 9600 8N1; it polls up to 5 times a second. `gs232-f1efw` steers too, but "
        "never answers: PstRotator then shows no position and repeats its order",
        (b"M235\r", b"W235 025\r", b"C2\r", b"C\r", b"S\r"),
        "users' reports",
    ),
    Program(
        "SatPC32",
        ("gs232b",),
        "serial",
        "rotor menu *Yaesu_GS-232*; limits and 450° in the same menu",
        (b"W235 025\r", b"C2\r"),
        "its manual, another builder's controller",
    ),
    Program(
        "OscarWatch",
        ("gs232a", "gs232b"),
        "serial or TCP",
        "its default is 4800 baud: set 9600, or `baud = 4800` on the link; 360/450 and elevation 90/180 as your rotor",
        (b"W235 025\r", b"C2\r", b"C\r", b"B\r", b"S\r"),
        "its source",
    ),
    Program(
        "SDRangel",
        ("gs232b", "rotctld"),
        "serial, or TCP",
        "GS-232, not the A form: it reads that ten times too small",
        (b"W235 025\r\n", b"M235\r\n", b"C2\r\n"),
        "its source",
    ),
    Program(
        "SDRangel, its SPID mode",
        ("md01",),
        "serial, with `pulses_per_degree = 2`",
        "SPID; it waits for an answer to each order, which only `md01` gives",
        (
            bytes.fromhex("57 00 00 00 00 00 00 00 00 00 00 1F 20"),
            bytes.fromhex("57 31 31 39 30 02 30 37 37 30 02 2F 20"),
        ),
        "its source",
        (("pulses_per_degree", 2),),
    ),
    Program(
        "predict",
        ("easycomm2",),
        "pty or serial",
        "`-a` and the port, of at most 13 characters, which it cuts silently: a short name, such as `/tmp/rotor`",
        (b"AZ235.0 EL25.0 \r\n",),
        "its source",
    ),
    Program(
        "Orbitron or SDR Console through WispDDE",
        ("gs232-f1efw", "gs232b"),
        "serial",
        "GS-232; it knows COM1 to COM4 only: renumber the port in the Device Manager",
        (b"W235 025\r",),
        "WispDDE's source",
    ),
    Program(
        "remoteRotator",
        ("gs232b", "gs232a"),
        "serial",
        "Yaesu; it asks every 5 s",
        (b"C2\r\n", b"M235\r\n", b"W235 025\r\n", b"S\r\n"),
        "its source",
    ),
    Program(
        "HSFL COSMOS",
        ("gs232b",),
        "serial or `pty`",
        '`empty_line = "?>"` on the link: it sends a bare CR before every command and waits for `?>`; no `ack`',
        (b"C2\r", b"W100 020\r", b"X2\r", b"C\r", b"B\r", b"S\r"),
        VERIFIED + " (its driver)",
    ),
    Program(
        "GS232-Remote (EA1NK)",
        ("gs232b",),
        "serial",
        '`ack = "cr"` on the link; it shows no position, because it expects both angles of `C`',
        (b"P45;\r", b"X3;\r", b"M235;\r", b"R;\r", b"C;\r", b"S;\r"),
        "its source",
    ),
    Program(
        "satnogs-client",
        ("rotctld", "gs232b"),
        "TCP or serial",
        "`SATNOGS_ROT_MODEL` ROT_MODEL_NETROTCTL or ROT_MODEL_GS232B; address or port as "
        "`SATNOGS_ROT_PORT`, and `SATNOGS_ROT_BAUD` 9600",
        (),
        VERIFIED,
    ),
    Program(
        "Termite, or any terminal",
        ("gs232b", "gs232-f1efw"),
        "serial",
        "9600; append CR, LF or CR LF, any will do",
        (b"w235 25\r", b"W235 025\n"),
        "general use",
    ),
    Program(
        "Loggers, balloon trackers and others that steer PstRotator",
        ("pstrotator",),
        "UDP `0.0.0.0:12000`",
        "PstRotator, the Pi's address, port 12000; answers come back at 12001",
        (
            b"<PST><AZIMUTH>85</AZIMUTH></PST>",
            b"<PST>AZ?</PST>",
            b"<PST><STOP>1</STOP></PST>",
            b"<PST><LLH>54.02523,20.89581,1</LLH></PST>",
        ),
        "PstRotator's manual, some programs' sources",
    ),
    Program(
        "N1MM Logger+",
        ("n1mm",),
        "UDP `0.0.0.0:12040`",
        "Configurer, Antennas: the rotor's name as `rotor_name`; Broadcast Data: Rotor to the Pi's address, port 12040",
        (
            b"<N1MMRotor><rotor>mast</rotor><goazi>55.0</goazi><offset>0.0</offset>"
            b"<bidirectional>0</bidirectional><freqband>14</freqband></N1MMRotor>",
        ),
        "other rotor servers for it",
    ),
    Program(
        "MacDoppler",
        ("macdoppler",),
        "UDP `0.0.0.0:9932`",
        "UDP broadcast on",
        (b"00000001 mac [AzEl Rotor Report:Azimuth:39.00, Elevation:0.00, SatName:XW-2C]",),
        "bridges from it to rotors",
    ),
    Program(
        "Stellarium",
        ("stellarium",),
        "TCP `0.0.0.0:10001`, and [`[station]`](keys.md#station)",
        "Plugins, Telescope Control: a telescope that a remote computer controls, the Pi's address, port 10001, J2000: "
        "[its section](../protocols.md#stellarium-and-other-telescope-programs)",
        (bytes.fromhex("1400 0000 0040075fda650600 00000040 72efff3f"),),
        "its source",
    ),
    Program(
        "SkySafari, KStars and other telescope programs",
        ("lx200",),
        "TCP or serial, and [`[station]`](keys.md#station)",
        "Meade LX200 Classic, alt-az; JNow",
        (b"#:Q#", b":GR#", b"#:GD#", b"\x06"),
        "Meade's protocol",
    ),
    Program(
        "FM-DX Webserver, its plug-in *PST Rotator*",
        ("pstrotatoraz",),
        "TCP `0.0.0.0:8080`",
        "`PSTRotatorUrl` in pstrotator.json: `http://192.168.1.20:8080`, the Pi's address",
        (
            b"GET /PstRotatorAz.htm HTTP/1.1\r\nHost: 192.168.1.20:8080\r\n\r\n",
            b"GET /PstRotatorAz.htm?az=85 HTTP/1.1\r\nHost: 192.168.1.20:8080\r\n\r\n",
        ),
        "its source",
    ),
    Program(
        "WSJT-X",
        ("wsjtx",),
        "its file `azel.dat`",
        "View, Astronomical data: keep it open",
        (b"02:59:48,198.9, 61.9,Moon\n",),
        "its source",
    ),
    Program(
        "Look4Sat (Android)",
        ("rotctld",),
        "TCP `0.0.0.0:4533`",
        "TCP, the Pi's address, port 4533; the default template `P $AZ $EL` is right",
        (b"P 114.8 9.05\n",),
        "its source",
    ),
    Program(
        "Look4Sat (Android), Bluetooth",
        ("easycomm2",),
        "[the Pi's own Bluetooth](../paths/servos.md#a-phone), `/dev/rfcomm0`",
        "the format `AZ$AZ EL$EL\\r`",
        (b"AZ114.8 EL9.05\r",),
        "its source",
    ),
)
