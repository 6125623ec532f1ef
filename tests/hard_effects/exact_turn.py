"""Torque of a whole machine at 50 digits, its running integral in closed form, and the range of that.

The integral of a row's torque is work: gas by the polytropic laws, kinetic energy, friction along the way. So the
means and the running integral need no quadrature; the extremes lie where torque = mean, and are found as roots.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

from tests.hard_effects.exact import Number, Row, State, mp, rotating_friction, rows


@dataclass(frozen=True)
class Machine:
    """All rows over a turn."""

    body: dict[str, Any]

    @cached_property
    def rows(self) -> list[Row]:
        return rows(self.body)

    @cached_property
    def shaft_friction(self) -> Number:
        return rotating_friction(self.body)

    def torque(self, theta: Number) -> Number:
        return sum(row.at(theta).torque for row in self.rows) + self.shaft_friction

    @cached_property
    def row_means(self) -> list[Number]:
        """Mean torque of every row: work of a turn over 2 pi."""
        return [_turn_work(row) / (2 * mp.pi) for row in self.rows]

    @cached_property
    def mean(self) -> Number:
        return sum(self.row_means) + self.shaft_friction

    @cached_property
    def size(self) -> Number:
        """Natural size of the work: what gas, masses and friction move in a turn, without regard for signs, J."""
        whole = self.shaft_friction * 2 * mp.pi
        for row in self.rows:
            gas = sum(c.area * (c.shrunk(mp.mpf(0)) + c.grown(c.stroke)) for c in row.chambers)
            fastest = max(abs(row.at(k * mp.pi / 16 - row.ahead).velocity) for k in range(9))
            whole += gas + row.mass * fastest**2 / 2 + 4 * row.friction * row.radius
        return whole

    def running(self, theta: Number) -> Number:
        """Integral of torque - mean from shaft angle 0, up to a constant, J."""
        total = mp.mpf(0)
        for row, mean in zip(self.rows, self.row_means, strict=True):
            turns = mp.floor((theta + row.ahead) / (2 * mp.pi))
            phi = theta + row.ahead - turns * 2 * mp.pi
            # the mean of the shaft's friction is itself
            total += State(row, phi).work - mean * phi
        return total

    @cached_property
    def breaks(self) -> list[Number]:
        """Shaft angles in [0, 2 pi) at which the torque jumps or has a kink: dead centres and valves."""
        names = {mp.mpf(0)}
        for row in self.rows:
            own = [mp.mpf(0), mp.pi]
            for side, chamber in enumerate(row.chambers):
                if not chamber.closed:
                    continue
                for travel, grows in ((chamber.suction_opens, True), (chamber.discharge_opens, False)):
                    x = travel if side == 0 else chamber.stroke - travel
                    angle = angle_at(row, x)
                    own.append(angle if grows == (side == 0) else 2 * mp.pi - angle)
            names |= {mp.fmod(angle - row.ahead + 4 * mp.pi, 2 * mp.pi) for angle in own}
        return sorted(names)

    def watched(self) -> list[Number]:
        """Angles between which the torque is followed: a grid, and denser towards dead centres and steep places."""
        grid = {2 * mp.pi * k / 240 for k in range(240)} | set(self.breaks)
        for row in self.rows:
            ratio = mp.mpf(0) if mp.isinf(row.length) else row.radius / row.length
            steep = mp.sqrt(1 - ratio**2)
            near = [(0, mp.mpf("1e-3")), (mp.pi, mp.mpf("1e-3"))]
            near += [(mp.pi / 2, steep / 8), (3 * mp.pi / 2, steep / 8)]
            for centre, distance in near:
                while distance < 0.1:
                    own = (centre - distance - row.ahead, centre + distance - row.ahead)
                    grid |= {mp.fmod(angle + 4 * mp.pi, 2 * mp.pi) for angle in own}
                    distance *= 1.5
        return sorted(grid)

    @cached_property
    def fluctuation(self) -> Number:
        """Range of the running integral over a turn, J."""
        edges = [*self.watched(), 2 * mp.pi]
        jumps = set(self.breaks)
        eps = mp.mpf(10) ** -40
        tried = list(edges)
        with mp.workdps(20):
            torque = [self.torque(edge) - self.mean for edge in edges]
        for k in range(len(edges) - 1):
            left = self.torque(edges[k] + eps) - self.mean if edges[k] in jumps else torque[k]
            after = edges[k + 1]
            right = self.torque(after - eps) - self.mean if after in jumps or k == len(edges) - 2 else torque[k + 1]
            if left * right < 0:
                tried.append(self._crossing(edges[k] + eps, after - eps))
        energy = [self.running(theta) for theta in tried]
        return max(energy) - min(energy)

    def _crossing(self, left: Number, right: Number) -> Number:
        """Root of torque - mean by regula falsi (Illinois), to half the digits: the extreme is flat there."""
        with mp.workdps(35):
            f_left, f_right = self.torque(left) - self.mean, self.torque(right) - self.mean
            for _ in range(80):
                if f_left == f_right:
                    break
                middle = (left * f_right - right * f_left) / (f_right - f_left)
                f_middle = self.torque(middle) - self.mean
                if f_middle * f_right < 0:
                    left, f_left = right, f_right
                else:
                    f_left /= 2
                step, right, f_right = abs(middle - right), middle, f_middle
                if f_middle == 0 or step < mp.mpf(10) ** -22:
                    break
            return right


def angle_at(row: Row, travel: Number) -> Number:
    """Own angle in [0, pi] at a displacement, from the triangle of crank, rod and axis."""
    r = row.radius
    if mp.isinf(row.length):
        return mp.acos(1 - travel / r)
    reach = r + row.length - travel
    with mp.workdps(110):  # rods up to 1e21 radii
        cosine = (r**2 + reach**2 - row.length**2) / (2 * r * reach)
        return mp.acos(max(min(cosine, 1), -1))


def _turn_work(row: Row) -> Number:
    gas = sum(c.work for c in row.chambers if c.closed)
    return gas + 4 * row.friction * row.radius
