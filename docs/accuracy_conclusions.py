"""What the tables of docs/accuracy.md say: every figure of the conclusions is read from them."""

import re
import textwrap
from collections.abc import Callable, Iterable
from dataclasses import dataclass


@dataclass(frozen=True)
class Row:
    """A line of a table: times in ms, errors relative."""

    method: str
    setting: str
    time: float
    error: float
    gap: float
    kind: str = ""  # of the figure, in a table of effects


def ladder(text: str, name: str) -> list[Row]:
    """The ladder of an example."""
    return [
        Row(cells[0], cells[1], _number(cells[2]), _number(cells[4]), _number(cells[6]))
        for cells in _cells(text, f"ladder {name}")
    ]


def effects(text: str, name: str) -> list[Row]:
    """The ladder of the figures of the turn of an example."""
    return [
        Row(cells[1], cells[2], _number(cells[3]), _number(cells[4]), 0.0, cells[0])
        for cells in _cells(text, f"effects {name}")
    ]


def names(text: str, kind: str) -> list[str]:
    return re.findall(rf"<!-- {kind} (\S+) -->", text)


def _cells(text: str, mark: str) -> Iterable[list[str]]:
    block = re.search(rf"<!-- {mark} -->\n(.*?)\n<!-- end -->", text, re.DOTALL)
    if block is None:
        raise LookupError(f"no table {mark}")
    return ([cell.strip() for cell in line.strip("|").split("|")] for line in block[1].splitlines()[2:])


def _number(cell: str) -> float:
    return float("nan") if cell == "-" else float(cell)


def on_ladders(text: str) -> str:
    """Conclusions on the methods, over all examples."""
    ladders = {name: ladder(text, name) for name in names(text, "ladder")}

    def of(method: str, setting: str) -> list[Row]:
        return [row for rows in ladders.values() for row in rows if (row.method, row.setting) == (method, setting)]

    default, double = of("the service", "relative gap 1e-06"), of("interior point, compiled", "relative gap 1e-09")
    alone = of("interior point, compiled", "relative gap 1e-06")
    batch = of("interior point, one of 1000", "relative gap 1e-06")
    extended, fifty = (of("interior point, finer numbers", setting) for setting in ("extended", "50 digits"))
    clarabel = of("cone program", "tolerance 1e-10")
    grid, corner = of("sampled angles", "720 angles"), of("polygonal cones", "256 sides")
    coarse = next(row for row in ladders["m-type-four"] if row.setting == "6 angles")
    return _list(
        f"**What the default buys.** With `relative_gap` 1e-6 the errors are at most {_worst(default, _error)}, and "
        f"proven to be at most {_worst(default, _gap)}, for {_range(default)} ms. Without the proof the rows "
        "would look equal.",
        "**What a digit costs.** From `relative_gap` 1e-3 to 1e-9 the time of the compiled interior point changes "
        f"by a factor of {_change(ladders, 'interior point, compiled')}. That of the cone program as matrices changes "
        f"by {_change(ladders, 'cone program, matrices')} from tolerance 1e-2 to 1e-10 (median of the examples). "
        f"Either "
        "gains a digit or more with every step. There is no reason to ask for less than the default.",
        f"**The last digits.** Double precision ends at a proof of {_worst(double, _gap)} at the worst. Extended "
        f"precision takes {_times(extended, double)} times as long and proves {_worst(extended, _gap)}; 50 digits "
        f"take {_times(fifty, double)} times as long and prove {_worst(fifty, _gap)}. The service goes there by "
        "itself, when double precision and clarabel do not suffice.",
        f"**A thousand at once.** A sweep pays {_range(batch)} ms for each program where a single one takes "
        f"{_range(alone)} ms. The steps are the same, and the work around them is shared. A solve by clarabel behind "
        f"cvxpy takes {_range(clarabel)} ms.",
        "**Digits of a grid are dear.** The proof of a sampled program falls as 1/n² (1 − cos(π/n), half a step of "
        f"the grid), and its time grows with n. 720 angles take {_times(grid, clarabel)} times the exact cone program "
        f"and prove {_worst(grid, _gap)} at the worst. The point can be better than its proof, and often is on "
        f"machines in one line. On the M type 6 angles are off by {coarse.error:.1e}.",
        f"**Polygons behave the same**, with 5/N² and a simplex method. 256 sides take {_times(corner, clarabel)} "
        f"times the exact cone program and prove {_worst(corner, _gap)} at the worst. Where a corner falls on the "
        f"optimum "
        'the point is exact by luck. The column "as drawn" shows it, and the certified gap does not reward it.',
    )


def on_effects(text: str) -> str:
    """Conclusions on the figures of the turn: 2D12 with gas, V8 with inertia alone."""
    gas, inertia = effects(text, "2d12"), effects(text, "v8-cross-plane")

    def of(rows: list[Row], kind: str, *settings: str) -> list[Row]:
        return [row for row in rows if kind in row.kind and row.setting in settings]

    def error(rows: list[Row], kind: str, *settings: str) -> str:
        figures = sorted({f"{100 * row.error:.2g}" for row in of(rows, kind, *settings)}, key=float)
        return " to ".join(dict.fromkeys((figures[0], figures[-1]))) + " percent"

    customary = ("10 deg", "15 deg")
    panels, fine = of(gas, "fluctuation", "exact kinematics")[0], of(gas, "fluctuation", "0.1 deg")[0]
    second = [row.error for row in gas if row.setting == "kinematics of order 2"]
    return _list(
        f"The customary 10 or 15 degrees are off by {error(gas, 'fluctuation', *customary)} in the energy that sizes "
        f"a flywheel. In the peak torque, at an opening valve between two samples, they are off by "
        f"{error(gas, 'peak', *customary)}. On the V8, where inertia rules, it is "
        f"{error(inertia, 'fluctuation', *customary)} and {error(inertia, 'peak', *customary)}. With 1 degree the "
        f"energy is off by "
        f"{error(gas, 'fluctuation', '1 deg')} and {error(inertia, 'fluctuation', '1 deg')}.",
        f"A step of 0.1 degree takes {fine.time / panels.time:.1f} times as long as the panels and leaves "
        f"{fine.error:.0e} where they leave {panels.error:.0e}.",
        f"The second order of the kinematics is no saving. It is off by {min(second):.0e} to {max(second):.0e} on "
        f"the 2D12, and by {error(inertia, 'fluctuation', 'kinematics of order 2')} on the V8. Its rods are "
        "shorter, and its torque is all inertia.",
    )


def on_peaks(text: str) -> str:
    """Conclusions on the peaks of the turn: a compressor with valves and friction, an engine of two turns."""
    compressor, engine = (_peaks(text, name) for name in ("2d12", "inline-four-engine"))

    def missed(rows: Peaks, setting: str) -> str:
        return f"{100 * rows['bearing load', setting].error:.2g} percent"

    brackets = [row for rows in (compressor, engine) for row in rows.values() if row.setting == "tolerance 1e-09"]
    uneven = [row for rows in (compressor, engine) for row in rows.values() if row.setting == "17 in a piece"]
    return _list(
        f"With the customary 10 degrees the bearing load of the 2D12 reads {missed(compressor, '10 deg')} low, that of "
        f"the engine {missed(engine, '10 deg')}. With 0.1 degree {missed(compressor, '0.1 deg')} and "
        f"{missed(engine, '0.1 deg')} are still missing. The peak stands at an opening valve, or at a dead centre on "
        "the one side of the jump of friction that counts, and no even step lands there.",
        "An uneven grid has both sides of every valve, dead centre and entry of a table, and samples between them. "
        f"With 17 samples in a piece it misses {_worst(uneven, _error)} at the worst, and cannot know that.",
        f"The bracket is proven to {_worst(brackets, _gap)} at the worst, where 1e-09 is requested.",
    )


Peaks = dict[tuple[str, str], Row]


def _peaks(text: str, name: str) -> Peaks:
    """The peaks of an example by figure and setting."""
    return {
        (cells[0], cells[2]): Row(cells[1], cells[2], _number(cells[4]), _number(cells[5]), _number(cells[6]), cells[0])
        for cells in _cells(text, f"peaks {name}")
    }


def _list(*points: str) -> str:
    wrap = {"width": 118, "initial_indent": "* ", "subsequent_indent": "  ", "break_on_hyphens": False}
    return "\n".join(textwrap.fill(point, break_long_words=False, **wrap) for point in points)


def _error(row: Row) -> float:
    return row.error


def _gap(row: Row) -> float:
    return row.gap


def _worst(rows: list[Row], value: Callable[[Row], float]) -> str:
    return f"{max(map(value, rows)):.0e}"


def _range(rows: list[Row]) -> str:
    return " to ".join(dict.fromkeys(f"{time:.2g}" for time in (min(r.time for r in rows), max(r.time for r in rows))))


def _times(rows: list[Row], references: list[Row]) -> str:
    """Ratios of times, example by example."""
    ratios = [row.time / other.time for row, other in zip(rows, references, strict=True)]
    return " to ".join(
        dict.fromkeys(f"{ratio:.2g}" if ratio < 100 else f"{ratio:.0f}" for ratio in (min(ratios), max(ratios)))
    )


def _change(ladders: dict[str, list[Row]], method: str) -> str:
    """Time of the sharpest setting over that of the loosest, the median of the examples."""
    ratios = []
    for rows in ladders.values():
        settings = [row for row in rows if row.method == method]
        ratios.append(settings[-1].time / settings[0].time)
    ratios.sort()
    middle = len(ratios) // 2
    return f"{(ratios[middle] + ratios[-1 - middle]) / 2:.1f}"
