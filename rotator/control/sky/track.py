"""Predicts the path of the target over the next minute, from the orders that a program sends once a second.

Knows the directions ordered and their moments. A satellite flies past in nearly a straight line. Such a line, projected
onto the plane that touches the sky at the target (gnomonic), is x(s) = (a + b s) / (1 + g s); y(s) has the same form
and the same g. So there are five numbers, which are fitted to the orders of the last minute by least squares. With real
passes and orders in whole degrees, the error is 0.2° now and 1.2° in 40 seconds. For orders with decimals the orders of
a few seconds are enough; older ones do harm, because the earth's rotation bends the line a little. Knows nothing of
axes, motors or tolerances.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence

from rotator.control.sky.angles import Vector, direction_of, dot, great_circle_deg, unit
from rotator.control.sky.equations import solved

MEMORY_S = {1.0: 25.0, 0.1: 8.0, 0.01: 4.0}
"""For each rounding of the orders: the time in which the weight of an order falls by the factor e. A longer time
averages the rounding better, a shorter one follows a bend better."""
KEPT_S = 4 * max(MEMORY_S.values())
THIN_S = 0.4
"""Of the orders within this time only the latest counts. The others would add no information."""
REFIT_S = 0.2
LEAST_ORDERS = 4
LONGEST_GAP_S = 5.0
"""Orders further apart are no stream: each of them is a new target."""
LEAST_TRAVEL = 1.0
"""Orders that differ by less than this many steps of their rounding may come from a target that stands."""
WHOLE_DEG = 1.0
STOOD = 3.0
"""The target stood if at its present speed the orders would have changed by this many steps, and they did not."""
LARGEST_SURPRISE_DEG = 4.0
"""An order further than this from where the path led is a new target."""
FASTEST_APPROACH = 0.02
"""By this share of its distance the fastest target comes nearer in a second: 8 km/s at 400 km."""
COASTING_S = 3.0
"""After the last order the path is followed for this long. Then the antenna stands at the last order."""

_SIDEWAYS_PRIOR = 1e-3
_APPROACH_PRIOR = 0.3
"""How strongly the fit assumes, from a few orders in whole degrees, that the target does not come nearer."""
_LEAST_FACING = 0.3
"""An order is left out if the cosine of its angle to the last order is smaller: it is too far from the plane."""


class Track:
    """Give it every order for a direction (`note`). Moments are seconds on one clock, and rise."""

    def __init__(self) -> None:
        self._orders: deque[tuple[float, float, float]] = deque()
        self._fit: _Fit | None = None

    def clear(self) -> None:
        self._orders.clear()
        self._fit = None

    def shift(self, azimuth_deg: float, elevation_deg: float) -> None:
        """A person shifts all orders by this, and the latest one comes again: the target has not moved."""
        kept = list(self._orders)[:-1]
        self.clear()
        self._orders.extend((at_s, (az + azimuth_deg) % 360.0, el + elevation_deg) for at_s, az, el in kept)

    def end(self) -> None:
        """No more orders come: the target stands at the last one."""
        last = list(self._orders)[-1:]
        self.clear()
        self._orders.extend(last)

    def note(self, now_s: float, azimuth_deg: float, elevation_deg: float) -> None:
        """An order for this direction arrived."""
        if self._orders:
            expected_deg = self.direction(now_s)
            surprised = great_circle_deg(*expected_deg, azimuth_deg, elevation_deg) > LARGEST_SURPRISE_DEG
            if surprised or now_s - self._orders[-1][0] > LONGEST_GAP_S:
                self.clear()
            elif now_s <= self._orders[-1][0] or (len(self._orders) > 1 and now_s - self._orders[-2][0] < THIN_S):
                self._orders.pop()
        self._orders.append((now_s, azimuth_deg, elevation_deg))
        while self._orders[0][0] < now_s - KEPT_S:
            self._orders.popleft()
        self._forget_standing()
        if not self._is_stream():
            self._fit = None
        elif self._fit is None or now_s - self._fit.at_s >= REFIT_S:
            self._fit = _Fit(self._orders, _grain_deg(self._orders))

    def moving(self, now_s: float) -> bool:
        """Whether there is a path; else the last order is where the target stands."""
        return self._fit is not None and now_s - self._orders[-1][0] <= COASTING_S

    def age_s(self, now_s: float) -> float:
        """How long the stream has lasted; 0 without one."""
        return now_s - self._orders[0][0] if self._fit is not None else 0.0

    def direction(self, at_s: float) -> tuple[float, float]:
        """Azimuth and elevation at a moment, now or to come. There must have been an order."""
        if self._fit is None:
            _, azimuth_deg, elevation_deg = self._orders[-1]
            return azimuth_deg, elevation_deg
        return self._fit.direction(at_s)

    def _forget_standing(self) -> None:
        """Forget the orders at which the target stood, once it moves: they say nothing about its path.

        Until a satellite rises, programs send the place where it will rise. Orders in whole degrees are kept: the few
        that follow say even less.
        """
        orders = list(self._orders)
        stands = next((number for number, order in enumerate(orders) if order[1:] != orders[0][1:]), len(orders))
        if stands < 2 or len(orders) - stands < LEAST_ORDERS - 1:
            return
        (since_s, *_), (until_s, *where_deg), (now_s, *here_deg) = orders[0], orders[stands - 1], orders[-1]
        grain_deg = _grain_deg(orders)
        least_pace_dps = (great_circle_deg(*where_deg, *here_deg) - grain_deg) / (now_s - until_s)
        if grain_deg < WHOLE_DEG and least_pace_dps * (until_s - since_s) > STOOD * grain_deg:
            for _ in range(stands - 1):
                self._orders.popleft()

    def _is_stream(self) -> bool:
        if len(self._orders) < LEAST_ORDERS:
            return False
        first, last = self._orders[0], self._orders[-1]
        return great_circle_deg(*first[1:], *last[1:]) >= LEAST_TRAVEL * max(_grain_deg(self._orders), 0.1)


class _Fit:
    """The line through space that fits the orders, seen from the last one; they are rounded to `grain_deg`."""

    def __init__(self, orders: Sequence[tuple[float, float, float]], grain_deg: float) -> None:
        memory_s = MEMORY_S[grain_deg]
        last_s, azimuth_deg, elevation_deg = orders[-1]
        self.at_s = last_s
        az, el = math.radians(azimuth_deg), math.radians(elevation_deg)
        # The plane touches the sky at the last order; its axes point along growing azimuth and growing elevation.
        self._ahead = unit(azimuth_deg, elevation_deg)
        self._right: Vector = (math.cos(az), -math.sin(az), 0.0)
        self._up: Vector = (-math.sin(el) * math.sin(az), -math.sin(el) * math.cos(az), math.cos(el))
        # x (1 + g s) = a + b s, and the same for y: linear in the five unknowns a, b, c, d, g. An order gives the rows
        # (1, s, 0, 0, -s x | x) and (0, 0, 1, s, -s y | y); what follows are the weighted sums of their products.
        n = ns = nss = nx = ny = nsx = nsy = nsxx = nssx = nssy = nsyy = nssxx = 0.0
        for at_s, order_az_deg, order_el_deg in orders:
            seen = unit(order_az_deg, order_el_deg)
            facing = dot(seen, self._ahead)
            if facing < _LEAST_FACING:
                continue
            s = at_s - last_s
            weight = math.exp(s / memory_s) * facing * facing
            x, y = dot(seen, self._right) / facing, dot(seen, self._up) / facing
            weight_s = weight * s
            weight_sx, weight_sy = weight_s * x, weight_s * y
            n += weight
            ns += weight_s
            nss += weight_s * s
            nx += weight * x
            ny += weight * y
            nsx += weight_sx
            nsy += weight_sy
            nssx += weight_sx * s
            nssy += weight_sy * s
            nsxx += weight_sx * x
            nsyy += weight_sy * y
            nssxx += weight_sx * s * x + weight_sy * s * y
        # The finer the orders, the weaker the assumptions: they go with the square, as the errors do.
        sideways, approach = (prior * grain_deg * grain_deg for prior in (_SIDEWAYS_PRIOR, _APPROACH_PRIOR))
        matrix = [
            [n, ns, 0.0, 0.0, -nsx],
            [ns, nss + sideways, 0.0, 0.0, -nssx],
            [0.0, 0.0, n, ns, -nsy],
            [0.0, 0.0, ns, nss + sideways, -nssy],
            [-nsx, -nssx, -nsy, -nssy, nssxx + approach],
        ]
        self._a, self._b, self._c, self._d, self._g = solved(matrix, [nx, nsx, ny, nsy, -nsxx - nsyy])
        if abs(self._g) > FASTEST_APPROACH:
            # No target is that fast. It has stood, for example where it rises, and has just begun to move.
            self._g = g = math.copysign(FASTEST_APPROACH, self._g)
            line = [[n, ns], [ns, nss + sideways]]
            self._a, self._b = solved(line, [nx + g * nsx, nsx + g * nssx])
            self._c, self._d = solved(line, [ny + g * nsy, nsy + g * nssy])

    def direction(self, at_s: float) -> tuple[float, float]:
        s = at_s - self.at_s
        x, y, z = self._a + self._b * s, self._c + self._d * s, 1.0 + self._g * s
        right, upward, ahead = self._right, self._up, self._ahead
        east = x * right[0] + y * upward[0] + z * ahead[0]
        north = x * right[1] + y * upward[1] + z * ahead[1]
        up = x * right[2] + y * upward[2] + z * ahead[2]
        azimuth_deg, elevation_deg = direction_of((east, north, up))
        return azimuth_deg % 360.0, elevation_deg


def _grain_deg(orders: Sequence[tuple[float, float, float]]) -> float:
    """What the latest orders are rounded to: whole degrees, tenths or finer."""
    angles_deg = [angle for order in list(orders)[-LEAST_ORDERS:] for angle in order[1:]]
    for grain_deg in (1.0, 0.1):
        if all(abs(angle / grain_deg - round(angle / grain_deg)) < 1e-6 for angle in angles_deg):
            return grain_deg
    return 0.01
