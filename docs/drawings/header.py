"""The Pi's 40-pin header: which pin is which GPIO, supply or ground. The same on every Pi with 40 pins."""

from __future__ import annotations

GPIO_PINS = {
    2: 3, 3: 5, 4: 7, 14: 8, 15: 10, 17: 11, 18: 12, 27: 13, 22: 15, 23: 16, 24: 18, 10: 19, 9: 21, 25: 22,
    11: 23, 8: 24, 7: 26, 0: 27, 1: 28, 5: 29, 6: 31, 12: 32, 13: 33, 19: 35, 16: 36, 26: 37, 20: 38, 21: 40,
}  # fmt: skip
"""GPIO (BCM) number to header pin."""

SDA_GPIO, SCL_GPIO = 2, 3
"""The header's I2C bus, number 1."""

RAILS = {1: "3.3 V", 17: "3.3 V", 2: "5 V", 4: "5 V"} | dict.fromkeys((6, 9, 14, 20, 25, 30, 34, 39), "GND")
"""Header pin to supply."""
