"""What a fuzz run says: the words of every protocol, and ways to spoil them.

Knows bytes. Knows no socket and no box.
"""

from __future__ import annotations

import random

FRAME = "57 00 00 00 00 00 00 00 00 00 00 %s 20"
GS232: tuple[bytes, ...] = (
    b"C2\r",
    b"W235 025\r",
    b"M100\r",
    b"R\r",
    b"U\r",
    b"S\r",
    b"P45\r",
    b"Z\r",
    b"O\r",
    b"F2\r",
    b"H3\r",
)
GS232 += (b"W010 100 020 110 030\r", b"T\r", b"N\r", b"X4\r", b"M005 010 020 030\r")
EASYCOMM: tuple[bytes, ...] = (
    b"AZ EL \n",
    b"AZ235.5 EL25.0\n",
    b"SA SE \n",
    b"ML\n",
    b"VU0900\n",
    b"PARK\n",
    b"RESET\n",
    b"GS\nGE\nVE\n",
)
ROTCTLD: tuple[bytes, ...] = (
    b"p\n",
    b"P 235.00 25.00\n",
    b"+\\set_pos 14 7\n",
    b";p\n",
    b"S\n",
    b"M CW 50\n",
    b"K\n",
    b"R 1\n",
)
ROTCTLD += (
    b"\\dump_state\n",
    b"C max_az 540\n",
    b"V SPEED 2\n",
    b"L -70.5 42.3 6\n",
    b"w C2\n",
    b"1\n",
    b"B 1 2 3 4\n",
)
DCU1: tuple[bytes, ...] = (b"AI1;", b"AP1235;AM1;", b"AP1235.0\r;", b"BI1;", b";", b"AS1;")
STATUS = bytes.fromhex(FRAME % "1F")
SPID: tuple[bytes, ...] = (STATUS, bytes.fromhex(FRAME % "0F"), bytes.fromhex("57 31 31 39 30 02 30 37 37 30 02 2F 20"))
SPID += (
    bytes.fromhex("57 02 00 00 00 00 00 00 00 00 00 14 20"),
    bytes.fromhex("57 35 39 35 30 0A 33 38 35 30 0A 2F 20"),
)
STRANGERS = (
    b"GET / HTTP/1.1\r\nHost: x\r\n\r\n",
    b"\xff\xfd\x01\xff\xfb\x03",
    "W235 025\r".encode("utf-16"),
    b"\0" * 64,
)

SPOKEN: dict[str, tuple[tuple[bytes, ...], bytes, bytes]] = {
    "gs232a": (GS232, b"\r\rC2\r", b"+0"),
    "gs232b": (GS232, b"\r\rC2\r", b"AZ="),
    "easycomm1": (EASYCOMM, b"\nAZ EL \n", b"AZ"),
    "easycomm2": (EASYCOMM, b"\nAZ EL \n", b"AZ"),
    "easycomm3": (EASYCOMM, b"\nAZ EL \n", b"AZ"),
    "rotctld": (ROTCTLD, b"\np\n", b"."),
    "dcu1": (DCU1, b"\rAI1;", b";"),
    "rot1prog": (SPID, STATUS, b"W"),
    "rot2prog": (SPID, STATUS, b"W"),
    "md01": (SPID, STATUS, b"W"),
}
"""What each protocol says; a good question, and what is in its answer."""
DATAGRAMS: dict[str, tuple[bytes, ...]] = {
    "pstrotator": (
        b"<PST><AZIMUTH>235.0</AZIMUTH><ELEVATION>25.0</ELEVATION></PST>",
        b"<PST>AZ?</PST><PST>EL?</PST>",
        b"<PST><STOP>1</STOP></PST>",
        b"<PST><PARK>1</PARK></PST>",
    ),
    "n1mm": (
        b"<N1MMRotor><rotor>x</rotor><goazi>55.0</goazi><offset>0.0</offset></N1MMRotor>",
        b"<N1MMRotor><stop><rotor>x</rotor><freqband>21.0</freqband></stop></N1MMRotor>",
    ),
    "macdoppler": (b"00000001 mac [AzEl Rotor Report:Azimuth:39.00, Elevation:0.00, SatName:XW-2C]",),
}
"""What comes by UDP; the last of them has nothing but orders, and is no link to be read_only."""
ALL = tuple(piece for pieces, _, _ in SPOKEN.values() for piece in pieces) + STRANGERS


def nasty(chance: random.Random, pieces: tuple[bytes, ...]) -> bytes:
    """Good bytes, damaged ones, another protocol's, or bytes of no protocol."""
    match chance.randrange(10):
        case 0:
            return chance.randbytes(chance.randrange(1, 300))
        case 1:
            return chance.choice(ALL)
        case 2:
            return chance.choice(pieces) * chance.randrange(1, 200)
        case 3:
            return bytes([chance.randrange(256)]) * chance.randrange(1, 40_000)
        case 4 | 5:
            return b"".join(chance.choices(pieces, k=chance.randrange(1, 6)))
    data = bytearray(b"".join(chance.choices(pieces, k=chance.randrange(1, 4))))
    for _ in range(chance.randrange(1, 5)):
        at = chance.randrange(len(data) + 1)
        match chance.randrange(4):
            case 0:
                data[at : at + 1] = bytes([chance.randrange(256)])
            case 1:
                del data[at : at + chance.randrange(1, 4)]
            case 2:
                data[at:at] = chance.choice((b" ", b"9", b"-", b".", b",", b"\0", b"\r", b"\n", b"W", b";"))
            case 3:
                data[at:at] = data[: chance.randrange(len(data) + 1)]
    return bytes(data)
