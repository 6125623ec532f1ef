"""Terms and rows of a statement with finitely many cuts."""

from optimizer.numerics.arrays import Complex, Real
from optimizer.program.cuts.cut import Cut, Quantity
from optimizer.program.cuts.dominance import Weighed
from optimizer.program.rows import Row
from optimizer.program.statement import PARTS, Term


class Terms:
    """Terms and rows of an objective, one after the other."""

    def __init__(self) -> None:
        self.constant: list[complex] = []
        self.influence: list[Real | Complex] = []
        self.row: list[int] = []
        self.names: list[Term] = []
        self.floor: list[float] = []
        self.group: list[int] = []
        self.rows: list[str] = []
        self.labels: set[str] = set()
        self.scalar: list[bool] = []

    def add(self, group: int, row: Row) -> None:
        for peak in row.peaks:
            count = peak.norms.constant.size
            self.constant += peak.norms.constant.tolist()
            self.influence += list(peak.norms.influence)
            self.row += [len(self.rows)] * count
            self.scalar += [False] * count
            self.names += [Term(peak.name, part, None, peak.scenario) for part in PARTS[:count]]
        self._end(group, row.name, float(sum(peak.floor for peak in row.peaks)))

    def add_cut(self, group: int, quantity: Quantity, cut: Cut, weighed: Weighed) -> None:
        name = quantity.name
        self.constant.append(weighed.weight * cut.constant)
        self.influence.append(weighed.weight * cut.influence)
        self.scalar.append(cut.scalar)
        self.row.append(len(self.rows))
        self.names.append(Term(name, "co", cut.angle_deg, quantity.scenario, cut.share))
        # of a root mean square the cuts have no angle
        called = f"{name} {len(self.rows)}" if cut.angle_deg is None else f"{name} at {cut.angle_deg!r} deg"
        called = called if quantity.scenario is None else f"{called} in {quantity.scenario}"
        if called in self.labels:
            # beside a jump both limits are of one angle
            called = f"{called}, {len(self.rows)}"
        self._end(group, called, weighed.offset + weighed.weight * cut.floor)

    def _end(self, group: int, name: str, floor: float) -> None:
        self.floor.append(floor)
        self.group.append(group)
        self.rows.append(name)
        self.labels.add(name)
