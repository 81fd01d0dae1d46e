"""Drills at random in simulated time: `python -m benchmarks.drills --seed N --hours H [--kind KIND] [--json]`.

Prints the drills and hours of each kind of rotor, and for each violation its seed and the smallest script that shows
it; `--replay FILE` plays such a script again. The exit code is 1 if there is a violation.
"""

from __future__ import annotations

import argparse
import json
import random
import sys
from dataclasses import asdict
from pathlib import Path

from benchmarks.drills.boxes import KINDS
from benchmarks.drills.campaign import Found, Tally, run, seeds
from benchmarks.drills.draw import draw
from benchmarks.drills.play import play
from benchmarks.drills.script import Drill

KEPT = Path("run/drills")
"""The folder for the scripts of violations."""


def main() -> None:
    given = _arguments()
    if given.replay:
        sys.exit(_replay(given.replay))
    seed = random.SystemRandom().randrange(1 << 31) if given.seed is None else given.seed
    drills = seeds(seed, given.hours, given.kind or "", beside_sectors=given.sectors)
    if given.json:
        tallies, found = run(drills, first=given.first)
        print(json.dumps(_as_dict(seed, tallies, found)))
    else:
        print(f"seed {seed}", flush=True)
        tallies, found = run(drills, first=given.first, tell=_tell)
        print(_table(tallies))
    sys.exit(bool(found))


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.drills", description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--seed", type=int, help="of the whole campaign; left out, a new one, which is printed")
    parser.add_argument("--hours", type=float, default=20.0, help="simulated hours, over all kinds (20)")
    parser.add_argument("--kind", choices=list(KINDS), help="only this kind of rotor")
    parser.add_argument("--sectors", action="store_true", help="each box beside forbidden sectors")
    parser.add_argument("--first", action="store_true", help="end at the first violation, and do not make it small")
    parser.add_argument("--json", action="store_true", help="one JSON object")
    parser.add_argument(
        "--replay", metavar="FILE", help="play the script in FILE, or the drill of a seed such as 7.12/servo"
    )
    return parser.parse_args()


def _replay(name: str) -> int:
    """Play one drill. Print its violations and the box's log."""
    try:
        drill = Drill.from_json(Path(name).read_text(encoding="utf-8")) if Path(name).exists() else _drawn(name)
    except ValueError as fault:
        print(f"{name}: {fault}", file=sys.stderr)
        return 2
    outcome = play(drill)
    print(*outcome.said, sep="\n")
    print("\n".join(map(str, outcome.violations)) or "nothing found")
    return int(bool(outcome.violations))


def _drawn(name: str) -> Drill:
    seed, _, kind = name.partition("/")
    if kind not in KINDS:
        raise ValueError(f"no such file, and no drill SEED.NUMBER/KIND; kinds: {', '.join(KINDS)}")
    return draw(seed, kind)


def _tell(found: Found) -> None:
    KEPT.mkdir(parents=True, exist_ok=True)
    path = KEPT / f"{found.seed}-{found.drill.kind}.json"
    path.write_text(found.drill.to_json(), encoding="utf-8")
    print(
        f"\n{found.violation}\n{found.drill.to_json()}drawn from {found.seed}/{found.drill.kind}; "
        f"replay it: python -m benchmarks.drills --replay {path}\n",
        flush=True,
    )


def _table(tallies: dict[str, Tally]) -> str:
    rows = [f"{'':<12} {'drills':>6} {'hours':>6} {'CPU s/h':>8}  violations"]
    for kind, tally in tallies.items():
        counts = ", ".join(f"{judge} {count}" for judge, count in tally.by_judge.items() if count) or "none"
        rows.append(f"{kind:<12} {tally.drills:>6} {tally.hours:>6.1f} {tally.cpu_s / tally.hours:>8.1f}  {counts}")
    total = sum(tally.hours for tally in tallies.values())
    rows.append(f"{'in all':<12} {sum(t.drills for t in tallies.values()):>6} {total:>6.1f}")
    return "\n".join(rows)


def _as_dict(seed: int, tallies: dict[str, Tally], found: list[Found]) -> dict[str, object]:
    return {
        "seed": seed,
        "kinds": {kind: asdict(tally) for kind, tally in tallies.items()},
        "found": [
            {"drawn_from": f"{each.seed}/{each.drill.kind}", **asdict(each.violation), "script": each.drill.to_json()}
            for each in found
        ],
    }


if __name__ == "__main__":
    main()
