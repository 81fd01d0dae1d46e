"""Run `python -m benchmarks.soak`: a busy box for an hour in real time.

Prints a table of figures; exit code 1, with what is wrong, when memory or files grow, a thread is lost, a relay is on
without an order or at the end, or a link no longer answers.
"""

from __future__ import annotations

import argparse
import asyncio
import json
import random
import sys

from benchmarks.soak import real, soaked


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("--hours", type=float, default=1.0)
    parser.add_argument("--minutes", type=float, help="the same in minutes")
    parser.add_argument("--seed", type=int, default=random.SystemRandom().randrange(1 << 31))
    parser.add_argument("--json", action="store_true", help="print the figures as JSON")
    given = parser.parse_args()
    hours = given.minutes / 60 if given.minutes else given.hours
    print(f"seed {given.seed}", file=sys.stderr)
    seen = asyncio.run(real.soak(3600 * hours, given.seed))
    figures, found = soaked.figures(seen), seen.found
    if given.json:
        print(json.dumps({"figures": figures, "found": found}, indent=2))
    else:
        print("| soak | figure |\n|---|---|")
        print("\n".join(f"| {name} | {value} |" for name, value in figures.items()))
        print("\n".join(found) or "nothing found", file=sys.stderr)
    sys.exit(bool(found))


if __name__ == "__main__":
    main()
