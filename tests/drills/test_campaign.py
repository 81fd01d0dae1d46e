"""The campaign as a person runs it: its figures by kind, one script again, and what it says to a wrong name."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import benchmarks.drills
from benchmarks.drills.accusations import TABLE

KNOWN = Path(benchmarks.drills.__file__).parent / "known" / "servo-kill.json"


def drills(*words: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "benchmarks.drills", *words], capture_output=True, text=True, check=False
    )


def test_a_campaign_tells_what_each_kind_was_put_through() -> None:
    done = drills("--seed", "11", "--hours", "0.005", "--kind", "servo", "--json")
    told = json.loads(done.stdout)
    assert told["seed"] == 11
    assert told["kinds"]["servo"]["hours"] >= 0.005
    assert set(TABLE) <= told["kinds"]["servo"]["by_judge"].keys()
    assert done.returncode == bool(told["found"])


def test_one_script_is_played_again() -> None:
    done = drills("--replay", str(KNOWN))
    assert done.returncode == 0
    assert done.stdout.splitlines()[-1] == "nothing found"


def test_a_wrong_script_and_an_unknown_kind_are_errors(tmp_path: Path) -> None:
    (tmp_path / "wrong.json").write_text("{}", encoding="utf-8")
    for name in (str(tmp_path / "wrong.json"), "7.1/steam-rotor"):
        done = drills("--replay", name)
        assert done.returncode == 2
        assert done.stderr.startswith(name)
        assert "Traceback" not in done.stderr
