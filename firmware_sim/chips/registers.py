"""What simulated chips of numbered registers on I2C share: the first byte of a write names the register of the next.

Knows the pointer, which goes on by itself. Knows no register.
"""

from __future__ import annotations


class Registers:
    """A chip says what a written register does (`_set`), and what a read at the pointer gives."""

    _pointer = 0

    def write(self, data: bytes) -> None:
        if not data:
            return
        self._pointer = data[0]
        for register, value in enumerate(data[1:], self._pointer):
            self._set(register, value)

    def _set(self, register: int, value: int) -> None:
        raise NotImplementedError
