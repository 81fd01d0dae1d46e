"""Moments are seconds since 1970, in UTC: the one that astronomers count from, and the length of a day."""

from __future__ import annotations

DAY_S = 86_400.0
J2000_S = 946_728_000.0
"""Noon of 1 January 2000 UTC, in seconds since 1970."""
