"""Files of elements as servers, shells and editors write them: each is read, or refused in one sentence."""

from __future__ import annotations

import codecs
import json
from collections.abc import Callable
from pathlib import Path

import pytest

from rotator.orbits.catalogue import Catalogue, Unknown
from rotator.orbits.element_files import MOST_BYTES, is_fault, parse, text_of
from rotator.orbits.elements import Elements, Notice
from tests.orbits.test_omm import MESSAGE, as_csv, close
from tests.orbits.test_tle import ISS, sums_up
from tests.tables import every_row

NAME, ONE, TWO = ISS.splitlines()
XML = "".join(f"<{key}>{value}</{key}>" for key, value in MESSAGE.items())
SEGMENT = f"<segment><metadata>{XML}</metadata></segment>"
KVN = "\n".join(f"{key} = {value}" for key, value in MESSAGE.items())
AMSAT = f"""\
SB KEPS @ AMSAT $ORB25059.N
2Line Orbital Elements 25059.AMSAT

HR AMSAT ORBITAL ELEMENTS FOR AMATEUR SATELLITES IN NASA FORMAT
FROM SOMEWHERE February 28, 2025
BID: $ORB25059.N
DECODE 2-LINE ELSETS WITH THE FOLLOWING KEY:
1 AAAAAU 00  0  0 BBBBB.BBBBBBBB  .CCCCCCCC  00000-0  00000-0 0  DDDZ
2 AAAAA EEE.EEEE FFF.FFFF GGGGGGG HHH.HHHH III.IIII JJ.JJJJJJJJKKKKKZ
TO ALL RADIO AMATEURS BT

{ISS}/EX
73 de somebody
"""
TEXTS = {
    "TLE": ISS,
    "without a name": f"{ONE}\n{TWO}\n",
    "Windows' ends of lines": ISS.replace("\n", "\r\n"),
    "an old Mac's ends of lines": ISS.replace("\n", "\r"),
    "blanks at the ends": ISS.replace("\n", "   \n"),
    "an empty line between all": ISS.replace("\n", "\n\n"),
    "a zero before the name": "0 " + ISS,
    "a small u": ISS.replace("25544U", "25544u"),
    "blanks that do not break": ISS.replace(" ", "\u00a0"),
    "remarks": f"# from somewhere\n{ISS}# the end\n",
    "copied with the marks of a page": f"<html><pre>\n{ISS}</pre>\n",
    "magnitudes": ISS.replace(NAME, f"{NAME}     30.0 20.0  0.0 -0.5 d"),
    "sizes without a magnitude": ISS.replace(NAME, f"{NAME}     30.0 20.0  0.0"),
    "AMSAT's nasa.all": AMSAT,
    "JSON": json.dumps([MESSAGE]),
    "JSON, one a line": json.dumps(MESSAGE) + "\n" + json.dumps(MESSAGE) + "\n",
    "JSON in a page of results": json.dumps({"count": 1, "results": [MESSAGE]}),
    "SatNOGS": json.dumps([{"tle0": f"0 {NAME}", "tle1": ONE, "tle2": TWO, "tle_source": "x", "norad_cat_id": 25544}]),
    "line1 and line2": json.dumps({"name": NAME, "date": "2025", "line1": ONE, "line2": TWO}),
    "both lines in one text": json.dumps({"name": NAME, "tle": f"{ONE}\r\n{TWO}"}),
    "a list of three lines": json.dumps([NAME, ONE, TWO]),
    "lists of three lines": json.dumps([[NAME, ONE, TWO]]),
    "CSV": as_csv(MESSAGE),
    "CSV below a remark": "# from somewhere\n" + as_csv(MESSAGE),
    "XML": f'<?xml version="1.0" encoding="UTF-8"?>\n<ndm><omm id="CCSDS_OMM_VERS"><body>{SEGMENT}</body></omm></ndm>',
    "XML with a namespace": f'<n:ndm xmlns:n="urn:x" xmlns="urn:y"><omm><body>{SEGMENT}</body></omm></n:ndm>',
    "KVN": f"CCSDS_OMM_VERS = 2.0\nCOMMENT EPOCH = none\n\n{KVN}",
    "KVN with units": f"CCSDS_OMM_VERS = 2.0\n{KVN}".replace("51.6353", "51.6353 [deg]"),
    "KVN with the day of the year": KVN.replace("2025-02-28T", "2025-059T"),
}
SAVED: dict[str, Callable[[str], bytes]] = {
    "UTF-8": lambda text: text.encode(),
    "UTF-8 with a mark": lambda text: text.encode("utf-8-sig"),
    "PowerShell's": lambda text: codecs.BOM_UTF16_LE + text.encode("utf-16-le"),
    "the other UTF-16": lambda text: codecs.BOM_UTF16_BE + text.encode("utf-16-be"),
    "UTF-16 without a mark": lambda text: text.encode("utf-16-le"),
    "Windows-1252": lambda text: text.encode("cp1252"),
}


@every_row("form", TEXTS)
def test_every_form_in_every_encoding(form: str) -> None:
    (expected,) = parse(ISS)
    for saved, encoded in SAVED.items():
        found = list(parse(text_of(encoded(TEXTS[form]))))
        assert found, saved
        assert all(close(each, expected) for each in found), saved
        assert {each.name for each in found if isinstance(each, Elements)} <= {NAME, "25544"}, saved


@pytest.mark.parametrize(
    "several",
    [
        f"<ndm><omm>{SEGMENT}</omm><omm>{SEGMENT.replace('25544', '7')}</omm></ndm>",
        f"CCSDS_OMM_VERS = 2.0\n{KVN}\n\nCCSDS_OMM_VERS = 2.0\n{KVN.replace('25544', '7')}\n",
        f"{KVN}\n{KVN.replace('25544', '7')}",
        ISS + "\n".join(sums_up(line.replace("25544", "00007")) for line in (ONE, TWO)),
    ],
)
def test_several_in_one_file(several: str) -> None:
    assert [each.catalogue_number for each in parse(several) if isinstance(each, Elements)] == [25544, 7]


def test_a_name_in_windows_letters() -> None:
    (found,) = parse(text_of(ISS.replace(NAME, "MÜNCHEN-1").encode("cp1252")))
    assert isinstance(found, Elements)
    assert found.name == "MÜNCHEN-1"


def test_a_set_without_checksum_is_taken_with_a_notice() -> None:
    text = f"{NAME}\n{ONE[:68]}\n{TWO[:68]}\n"
    *sets, told = parse(text + text.replace("25544", "25545"))
    assert [each.catalogue_number for each in sets if isinstance(each, Elements)] == [25544, 25545]
    assert isinstance(told, Notice)
    assert not is_fault(told)
    assert told.startswith("line 2: 2 sets without checksum are taken")


@every_row(
    ("text", "told"),
    [
        (AMSAT.replace("9996", "9995"), "line 13: the checksum of its first line is 6, not 5"),
        (f"{NAME}\n{ONE[:68]}\n{TWO}", "line 2: its first line has 68 characters in place of 69"),
        (f"{NAME}\n{ONE[:20]}{ONE[21:68]}\n{TWO[:68]}", "line 2: its first line has 67 characters in place of 69"),
        (f"{NAME}\n{ONE[:8]} {ONE[8:67]}\n{TWO[:68]}", "line 2: its columns are shifted"),
        (json.dumps([{"tle1": ONE[:-1] + "5", "tle2": TWO}]), "message 1: the checksum of its first line is 6, not 5"),
        (KVN.replace("51.6353", "steep"), "line 1 (ISS (ZARYA)): INCLINATION is 'steep', no number"),
        (f"<omm>{SEGMENT.replace('51.6353', 'steep')}</omm>", "message 1 (ISS (ZARYA)): INCLINATION is 'steep', no"),
    ],
)
def test_what_is_wrong_is_told_with_its_place(text: str, told: str) -> None:
    assert [str(each)[: len(told)] for each in parse(text)] == [told]


@every_row(
    ("content", "told"),
    [
        (b"<!DOCTYPE html><html><body>404 Not Found</body></html>", "it is a web page"),
        (b"\x1f\x8b\x08\x00" + bytes(20), "it is compressed: unpack it first"),
        (b"PK\x03\x04" + bytes(20), "it is compressed: unpack it first"),
        (b"\x89PNG\r\n\x1a\n" + bytes(20), "no text"),
        (b"<omm><segment>", "line 1: no XML"),
        (b"<!DOCTYPE omm [<!ENTITY a 'b'>]><omm><segment>&a;</segment></omm>", "a document type"),
        (b"just words\n", "neither TLE nor OMM"),
    ],
)
def test_what_holds_no_elements_is_told_what_it_is(content: bytes, told: str) -> None:
    with pytest.raises(ValueError, match=told):
        list(parse(text_of(content)))


@pytest.mark.parametrize("text", ["", "\n \n", "# nothing yet\n", "[]"])
def test_an_empty_file_has_none(text: str) -> None:
    assert list(parse(text_of(text.encode()))) == []


def test_a_large_file_is_read_in_a_time_that_grows_with_it() -> None:
    """Two megabytes, of which most is prose, names without sets, or one endless line."""
    assert MOST_BYTES > 2_000_000
    assert len([each for each in parse(ISS * 12_000) if isinstance(each, Elements)]) == 12_000
    list(parse("ISS\n" * 500_000 + ISS))
    with pytest.raises(ValueError, match="neither"):
        list(parse("x" * 2_000_000))


def satellite(name: str, number: int, node_deg: float, day: str = "25059.54152977") -> str:
    one = sums_up(f"1 {number:05d}{ONE[7:18]}{day}{ONE[32:]}")
    return f"{name}\n{one}\n{sums_up(f'2 {number:05d}{TWO[7:17]}{node_deg:8.4f}{TWO[25:]}')}\n"


def test_two_satellites_under_one_number_are_two(tmp_path: Path) -> None:
    (tmp_path / "new.txt").write_text(satellite("CUBE-A", 99999, 208.9) + satellite("CUBE-B", 99999, 108.9))
    catalogue = Catalogue([str(tmp_path)])
    assert [each.name for each in catalogue.satellites] == ["CUBE-A", "CUBE-B"]
    assert [catalogue.find(name).ascending_node_deg for name in ("cube a", "CUBE-B")] == [208.9, 108.9]
    with pytest.raises(Unknown, match=r"may be CUBE-A \(99999\), CUBE-B \(99999\): name one by its whole name"):
        catalogue.find("99999")


@pytest.mark.parametrize(
    ("older", "newer"), [("ISS (ZARYA)", "ISS"), ("AO-07", "OSCAR 7 (AO-7)"), ("NOAA 15 [B]", "NOAA 15"), ("", "ISS")]
)
@pytest.mark.parametrize("newer_first", [False, True])
def test_one_satellite_twice_is_one_and_its_newest_set_counts(
    tmp_path: Path, older: str, newer: str, *, newer_first: bool
) -> None:
    sets = [satellite(older, 25544, 10.0), satellite(newer, 25544, 20.0, "25060.54152977")]
    for place, text in enumerate(reversed(sets) if newer_first else sets):
        (tmp_path / f"{place}.txt").write_text(text)
    assert [each.ascending_node_deg for each in Catalogue([str(tmp_path)]).satellites] == [20.0]
