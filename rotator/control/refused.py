"""An order that cannot be carried out, with the reason as a sentence for the log.

Knows the reason. Knows neither the order nor its sender.
"""

from __future__ import annotations


class Refused(ValueError):  # noqa: N818 - a sentence for a person; the program has not failed
    """The order is not carried out. Except where a method says otherwise, everything stays as it was."""
