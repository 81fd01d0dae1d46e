"""The whole numbers behind the name of a benchmark: `python -m benchmarks.recognition 500 7`.

Knows their sequence and their usual values. Knows no benchmark.
"""

from __future__ import annotations

import argparse


def numbers(about: str | None, **usual: int) -> list[int]:
    """The numbers of this command line, in the sequence of `usual`, which names each with its usual value.

    `about` is shown by `--help`, line by line as it stands.
    """
    parser = argparse.ArgumentParser(description=about, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, value in usual.items():
        parser.add_argument(name, type=int, nargs="?", default=value, help=f"{value}, unless a number is given")
    return list(vars(parser.parse_args()).values())
