"""A rotator controller on a Raspberry Pi that a PC takes for a Yaesu GS-232."""

__version__ = "0.1.0"
