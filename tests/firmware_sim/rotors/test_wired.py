"""What is wired to a simulated rotor: an axis that is misspelt is refused, and real threads do not block each other."""

from __future__ import annotations

import threading
import time

from firmware_sim.rotors.rotor import SimRotor
from rotator.assembly.simulation import SimulatedStation
from tests.rotors.rig import configured


def test_looking_at_servos_while_their_board_is_written_never_blocks() -> None:
    """Two threads take the locks of the rotor and of its chip at the same time, again and again."""
    rotor: SimRotor = SimulatedStation(configured("servos"), time.monotonic, None, (90.0, 90.0)).build()

    def look() -> None:
        for _ in range(3000):
            rotor.antenna()

    def write() -> None:
        for step in range(3000):
            rotor.bus.write_i2c_block_data(0x40, 0x06, [0, 0, step % 256, 1])

    threads = [threading.Thread(target=work, daemon=True) for work in (look, write)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(timeout=30.0)
        assert not thread.is_alive(), "they wait for each other"
