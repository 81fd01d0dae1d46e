"""Elements fetched by a running box, and a table handed in to it, as a person does both."""

from __future__ import annotations

import json
import re
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

from tests.cli.conftest import Running
from tests.fetching.http_server import Said, serving
from tests.orbits.skyfield_oracle import TLE

Start = Callable[..., Running]
Rotator = Callable[..., subprocess.CompletedProcess[str]]


def elements(rotator: Rotator, config: Path) -> Any:
    return json.loads(rotator("sky", "elements", "--json", "--config", config).stdout)


def test_a_box_fetches_once_and_knows_the_satellites_after_its_restart_too(
    start: Start, rotator: Rotator, rotator_here: Rotator, tmp_path: Path
) -> None:
    config = tmp_path / "box.toml"
    with serving(Said(content=TLE.read_bytes())) as server:
        config.write_text(f'[station]\nlocator = "JO62qm"\n[sky]\nfetch = "{server.address()}"\n', encoding="utf-8")
        assert elements(rotator_here, config)["fetch"][0]["reason"] == "not asked yet"
        box = start("run", "--config", config)
        box.until("SIMULATED")
        assert rotator_here("tell", "--config", config, "clock-is-right").returncode == 0
        assert any(elements(rotator, config)["satellites"] == 3 for _ in range(100))
        assert box.stop() == 0
        again = start("run", "--config", config)
        again.until("SIMULATED")
        tracked = rotator_here("track", "iss", "--config", config)
        assert tracked.stdout.startswith(("ISS rises in ", "ISS is up for ")), tracked.stderr
        assert again.stop() == 0
        assert len(server.asked) == 1
    (fetched,) = elements(rotator_here, config)["fetch"]
    assert (fetched["satellites"], fetched["reason"]) == (3, None)
    text = rotator_here("sky", "elements", "--config", config).stdout
    assert re.search(r"last good .* UTC .*: 3 satellites\n  not asked again before ", text)
    assert rotator_here("sky", "where", "so50", "--config", config).returncode == 0


def test_a_table_is_flown_and_its_mistakes_are_told_with_their_lines(
    start: Start, rotator_here: Rotator, tmp_path: Path, config: Path
) -> None:
    """The box needs no place for it."""
    (tmp_path / "pass.csv").write_text("t,az,el\n100,20,5\n\n140,50,25\n", encoding="utf-8")
    (tmp_path / "back.csv").write_text("t,az,el\n100,20,5\n\n40,60,30\n", encoding="utf-8")
    box = start("run", "--config", config)
    box.until("SIMULATED")
    mistaken = rotator_here("track", "back.csv", "--config", config)
    assert mistaken.returncode == 1
    assert "back.csv:4: t must rise from row to row: 40 comes after 100" in mistaken.stderr
    without = rotator_here("track", "polaris", "--config", config)
    (tmp_path / "polaris").write_text("no table\n", encoding="utf-8")
    named = rotator_here("track", "polaris", "--config", config)
    assert (named.stdout, named.stderr) == (without.stdout, without.stderr), "a name without a dot is a target's"
    told = rotator_here("track", "pass.csv", "--config", config).stdout
    assert re.fullmatch(r"The table pass begins in 1:[0-5]\d min\. The antenna waits for it there\.\n", told)
    where = rotator_here("where", "--config", config).stdout
    assert re.search(r"^tracks: pass, begins in 1:[0-5]\d min$", where, re.MULTILINE)
    tracks = json.loads(rotator_here("where", "--json", "--config", config).stdout)["tracks"]
    assert tracks["name"] == "pass"
    assert tracks["ends_in_s"] > tracks["begins_in_s"] + 39
    assert box.stop() == 0


def test_a_name_that_is_taken_for_a_locator_is_told_as_one(start: Start, rotator_here: Rotator, tmp_path: Path) -> None:
    """FO29 is a satellite, and where its elements are missing a square of the earth: a person must see which."""
    config = tmp_path / "box.toml"
    config.write_text('[station]\nlocator = "JO62qm"\n', encoding="utf-8")
    box = start("run", "--config", config)
    box.until("SIMULATED")
    told = {
        words: rotator_here("track", *words.split(), "--config", config).stdout
        for words in ("fo29", "jn58td long", "180 45")
    }
    assert told == {
        "fo29": "The antenna points at the locator FO29, and stays.\n",
        "jn58td long": "The antenna points at the locator JN58TD LONG, and stays.\n",
        "180 45": "The antenna goes there, and stays.\n",
    }
    assert box.stop() == 0
