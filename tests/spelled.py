"""Numbers as programs spell them: signs, zeros in front and behind, points, commas, exponents, many digits.

Knows spellings and their values, by Python's own `float`. Knows no protocol.
"""

from __future__ import annotations

import random

NO_NUMBERS = ["nan", "inf", "-inf", "infinity", "1e999", "0x10", "1x0", "1O0", "1..5", "1.5.2", "--5", "1e", "1e+",
              "1_0", "e5"]  # fmt: skip


def spelled(rng: random.Random, top: int) -> tuple[str, float]:
    """A number from 0 to `top`, and its value."""
    while (number := _spelled(rng, top))[1] > top:
        pass  # rounded up
    return number


def _spelled(rng: random.Random, top: int) -> tuple[str, float]:
    digits = rng.choice([0, 1, 2, 6, 15, 17, 20, 40])
    number = f"{rng.random() * top:.{digits}f}"
    if rng.random() < 0.3:
        number = f"{rng.random() * top:.{digits}e}"
    elif rng.random() < 0.2:
        # The same with the point moved, as no printf writes it.
        power = rng.randrange(-9, 9)
        number = f"{rng.random() * top / 10.0**power:.{max(power, 0) + digits}f}e{power}"
    if rng.random() < 0.2 and number.startswith("0."):
        number = number[1:]
    if rng.random() < 0.1 and "." not in number and "e" not in number:
        number += "."
    if rng.random() < 0.3:
        number = "0" * rng.randrange(1, 30) + number
    if rng.random() < 0.2:
        number = "+" + number
    if rng.random() < 0.3:
        number = number.replace("e", "E")
    if rng.random() < 0.3:
        number = number.replace(".", ",")
    return number, value(number)


def value(text: str) -> float:
    return float(text.replace(",", "."))
