"""The check of elements: their files, their age, and what came of fetching them."""

from __future__ import annotations

from dataclasses import replace

from rotator.store.fetches import Asked, FetchesFile
from tests.doctor.conftest import Pi
from tests.orbits.skyfield_oracle import TLE

MARCH_S = 1_740_787_200.0
ADDRESS = "http://192.168.1.5:8233/elements"


def test_old_and_broken_files_are_told(pi: Pi) -> None:
    folder = pi.machine.at("/var/lib/rotator")
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "good.tle").write_bytes(TLE.read_bytes())
    pi.station('[sky]\nelements = ["/var/lib/rotator/good.tle", "/var/lib/rotator/gone.tle"]\n')
    pi.change(utc_s=lambda: MARCH_S)
    gone, fresh = pi.found("elements")
    assert (gone.mark, fresh.mark) == ("✗", "✓")
    assert "gone.tle: no such file" in gone.found
    assert fresh.found == "3 satellites, the newest elements are 0.4 days old"
    pi.change(utc_s=lambda: MARCH_S + 30 * 86_400)
    assert pi.found("elements")[1].mark == "!"


def test_a_server_that_refuses_is_told(pi: Pi) -> None:
    pi.station(f'[sky]\nfetch = "{ADDRESS}"\n')
    assert [each.mark for each in pi.found("elements")] == ["–"]
    record = FetchesFile(pi.machine.at("/var/lib/rotator/fetches.json"))
    asked = Asked(ADDRESS, MARCH_S, 86_400.0, "the server answers 403 Forbidden", whole_host=True)
    record.save({ADDRESS: asked})
    (finding,) = pi.found("elements")
    assert (finding.mark, finding.found) == ("!", f"{ADDRESS}: the server answers 403 Forbidden")
    record.save({ADDRESS: replace(asked, trouble="", sets=90, good_utc_s=MARCH_S)})
    assert [each.mark for each in pi.found("elements")] == ["✓"]
