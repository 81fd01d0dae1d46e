"""The tables [panel] and [limits]: a front panel, and limit switches on the rotor, with their pins and inputs.

A part without a key is not fitted. Knows which parts need each other. Knows no driver, and not what a switch does.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

from pydantic import Field

from rotator.config.chips import I2CChip
from rotator.config.table import Channel, Gpio, I2CAddress, I2CBus, Table, twice

Output = Annotated[int, Field(ge=0, le=15)]

KNOBS = ("azimuth_knob", "elevation_knob")
INPUTS = (*KNOBS, "jog", "reference")
SWITCHES = ("mode_msb", "mode_lsb", "calibrate", "stop")
METERS = ("azimuth_meter", "elevation_meter")
LAMPS = (
    "lamp_manual", "lamp_park", "lamp_auto", "lamp_jog", "lamp_data", "lamp_motor", "lamp_stop",
    "lamp_azimuth_pulse", "lamp_elevation_pulse", "lamp_switch",
)  # fmt: skip


class PanelTable(Table):
    adc_bus: I2CBus = 1
    """The bus of the ADS1115 for knobs and jog switches."""
    adc_address: I2CAddress = 0x49
    """0x49 with its ADDR pin at its supply."""
    azimuth_knob: Channel | None = None
    elevation_knob: Channel | None = None
    """The wiper of the knob; needs the mode switch."""
    knob_lowest_reading: float = Field(0.02, ge=-0.1, le=1)
    knob_highest_reading: float = Field(0.98, ge=0, le=1.1)
    """A knob's reading outside these means a broken wire and moves nothing; -0.1 and 1.1 without end resistors."""
    knob_zero: float = Field(0.075, ge=0, le=0.2)
    """A knob's reading at its minimum; 0 without end resistors."""
    jog: Channel | None = None
    """Both jog switches, over their resistors."""
    reference: Channel | None = None
    """The supply of knobs and jog switches, whose voltage then does not matter."""
    supply_v: float = Field(3.3, gt=0.5, le=5.5)
    """The same supply where no input measures it."""
    mode_msb: Gpio | None = None
    mode_lsb: Gpio | None = None
    """The mode switch's contacts of value 2 and 1, to ground; closed ones add up: MANUAL 0, PARK 1, AUTO 2, JOG 3."""
    calibrate: Gpio | None = None
    """The calibrate switch, to ground: closed at power-up, it calibrates the knobs. Needs the mode switch."""
    stop: Gpio | None = None
    """The stop button, normally closed, to ground: a broken wire acts as a pressed button."""
    azimuth_nudge_deg: float = Field(5.0, gt=0, le=45)
    elevation_nudge_deg: float = Field(5.0, gt=0, le=45)
    """The step of a press of the jog switch in AUTO; a rotor that counts: its pulse spacing."""
    outputs_bus: I2CBus = 1
    """The bus of the PCA9685 for meters and lamps; servos need another."""
    outputs_address: I2CAddress = 0x41
    """0x41 with its bridge A0 closed."""
    azimuth_meter: Output | None = None
    elevation_meter: Output | None = None
    """The output of the meter, over its trimmer."""
    meter_full_scale: float = Field(1.0, gt=0, le=1)
    """A meter's duty cycle at full scale."""
    lamp_manual: Output | None = None
    lamp_park: Output | None = None
    lamp_auto: Output | None = None
    lamp_jog: Output | None = None
    """Lit in the mode of its name."""
    lamp_data: Output | None = None
    """Lit while data comes from a program."""
    lamp_motor: Output | None = None
    """Lit while a motor runs."""
    lamp_stop: Output | None = None
    """Lit from a press of the stop button until the release."""
    lamp_azimuth_pulse: Output | None = None
    lamp_elevation_pulse: Output | None = None
    """Lit while the index contact is closed."""
    lamp_switch: Output | None = None
    """Lit when a jog switch counts, and until the mode switch has settled."""

    def faults(self) -> Iterator[str]:
        """Pins and addresses that are used twice are found by the model of the whole file."""
        if self.has_mode_switch is not (self.mode_lsb is not None):
            yield "mode_msb and mode_lsb are the two contacts of one switch: give both or neither"
        orphans = self.given(*KNOBS, "calibrate")
        if orphans and not self.has_mode_switch:
            yield f"without the mode switch (mode_msb, mode_lsb) {' and '.join(orphans)} would do nothing"
        if self.reference is not None and not self.inputs:
            yield "reference: neither a knob nor jog is fitted"
        for kind, keys in (("input", INPUTS), ("output", (*METERS, *LAMPS))):
            for place, users in twice((place, key) for key, place in self.given(*keys).items()).items():
                yield f"{kind} {place} is used by {' and '.join(users)}"

    @property
    def inputs(self) -> dict[str, int]:
        """The converter's input of each fitted knob and of the jog switches, by key."""
        return self.given(*KNOBS, "jog")

    @property
    def switches(self) -> dict[str, int]:
        """The GPIO of each fitted switch, by key."""
        return self.given(*SWITCHES)

    @property
    def meters(self) -> dict[str, int]:
        """The output of each meter, by its axis."""
        return {key.removesuffix("_meter"): output for key, output in self.given(*METERS).items()}

    @property
    def lamps(self) -> dict[str, int]:
        """The output of each lamp, by its name."""
        return {key.removeprefix("lamp_"): output for key, output in self.given(*LAMPS).items()}

    @property
    def has_mode_switch(self) -> bool:
        return self.mode_msb is not None

    @property
    def uses_adc(self) -> bool:
        return bool(self.inputs)

    @property
    def uses_outputs(self) -> bool:
        return bool(self.meters or self.lamps)

    def chips(self) -> list[I2CChip]:
        """The panel's converter and its output board, where a part uses them."""
        used = []
        if self.uses_adc:
            used.append(I2CChip(self.adc_bus, self.adc_address, "panel.adc_address", "ADS1115"))
        if self.uses_outputs:
            used.append(I2CChip(self.outputs_bus, self.outputs_address, "panel.outputs_address", "PCA9685"))
        return used

    @property
    def fitted(self) -> bool:
        """Whether there is a panel at all."""
        return bool(self.switches or self.uses_adc or self.uses_outputs)


class LimitsTable(Table):
    """Normally closed, to ground: a broken wire acts as a reached limit."""

    azimuth_low: Gpio | None = None
    azimuth_high: Gpio | None = None
    elevation_low: Gpio | None = None
    elevation_high: Gpio | None = None
    """The switch at this end; azimuth high is the clockwise one."""

    @property
    def switches(self) -> dict[str, int]:
        """The GPIO of each fitted switch, by key."""
        return self.given(*type(self).model_fields)
