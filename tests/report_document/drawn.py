"""Pictures of made-up figures, shape by shape: places, sizes, colours and words of all that is drawn.

``python -m tests.report_document.drawn`` prints the table of drawn.txt, which tests/report_document/test_drawn.py
compares. What the pictures mean is held by others, which read them back; here is how they look. Nothing is computed.
"""

import cmath
import math
import re
import sys
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

from schemas.answer.dynamics import Gas
from schemas.answer.outputs import Stage
from schemas.machine.reciprocating import ReciprocatingMachine
from schemas.request.accuracy import AccuracyAnswer
from schemas.request.picture import PictureStyle
from service.drawings.svg import SERIES, Drawing, beside
from service.report import charts
from service.report.accuracy_picture import draw
from service.report.indicator import indicators
from service.report.loci import Curve, locus
from service.report.pictures import styled
from service.report.scatter import Column, scatter
from service.report.stage_scheme import stage_scheme
from tests.optimize.machines import machine, row, throw, web
from tests.report_document.subjects import accuracy

TABLE = Path(__file__).with_name("drawn.txt")
#: of a long line its beginning, and every so manieth of its points
_BEGINNING, _EVERY = 8, 17
#: what every shape says
_COMMON_ATTRIBUTES = r' (?:xmlns="[^"]*"|fill="none"|stroke-linejoin="round"|stroke="none"|/>$)'

_TURN = [10.0 * k for k in range(36)]
_MACHINE = ReciprocatingMachine.model_validate(
    machine(
        [
            throw(-0.2, 30.0, [row(60.0, 12.0), row(240.0, 12.0)], 0.11, 5.0),
            throw(0.3, 170.0, [row(60.0, 9.0, offset_m=0.02)], 0.08, 3.0),
        ],
        [web("a", -0.4, 4.0), web("b", 0.5, 3.0)],
        rotation="cw",
    )
)


def shapes(svg: str) -> Iterator[str]:
    """A line for every shape; of long lines some of their points."""
    for line in re.sub(r"(</?(?:g|text|path|circle)\b)", r"\n\1", svg).splitlines():
        # what says nothing but that something ends
        if line.strip() and line not in ("</text>", "</g>", "</g></svg>", "</text></svg>"):
            yield re.sub(_COMMON_ATTRIBUTES, "", re.sub(r'(?<= d=")[^"]*', _some, line)).strip()


def _some(path: re.Match[str]) -> str:
    points = path[0].split("L")
    if len(points) <= 2 * _BEGINNING:
        return path[0]
    return "L".join([*points[:_BEGINNING], *points[_BEGINNING:-1:_EVERY], points[-1]]) + f" of {len(points)}"


def _waves(*sizes: float) -> list[charts.Line]:
    lines = [
        charts.Line(
            f"row {'abcdefghij'[k]} of throw {k}",
            [size * math.cos(math.radians((k + 1) * at)) + 0.2 * size * k for at in _TURN],
        )
        for k, size in enumerate(sizes)
    ]
    return [
        *lines[:-1],
        charts.Line(lines[-1].name, [None if 4 < k < 9 else v for k, v in enumerate(lines[-1].values)]),
    ]


def _loop(centre: complex, size: float) -> Curve:
    points = [centre + size * (cmath.exp(0.2j * k) + 0.3 * cmath.exp(-0.4j * k)) for k in range(31)]
    return Curve("A", points, centre, 1.3 * size, SERIES[1], "7 3")


def _designs(count: int) -> Drawing:
    places = [(k * 37 % 101, k * 53 % 97) for k in range(count)]
    mass = Column("total_mass_kg", "kg", [20.0 + count for count, _ in places])
    return scatter(mass, Column("force_peak_N", "N", [2e4 + 300.0 * count for _, count in places]))


def _rung(method: str, setting: str, time_ms: float | None, error: float, best: bool) -> dict[str, Any]:
    return {"method": method, "setting": setting, "time_ms": time_ms, "relative_error": error, "on_frontier": best}


def _ladder() -> str:
    rungs = [
        _rung("sampled_angles", "36 angles", 0.9, 3e-3, True),
        _rung("sampled_angles", "360 angles", 4.9, 3e-5, False),
        _rung("sampled_angles", "3600 angles", None, 3e-7, False),
        _rung("slsqp", "tolerance 1e-6", 2.5, 2e-8, True),
        _rung("slsqp", "tolerance 1e-9", 91.0, 0.0, True),
    ]
    answer = accuracy(*rungs)
    assert isinstance(answer, AccuracyAnswer)
    return draw("A machine of a very long name, which a title has no room for however it is written", answer)


def _acting(motion: str, direction: float | None, peak: float, minor: float = 0.0, order: int = 1) -> dict[str, Any]:
    return {
        "quantity": "force", "order": order, "frequency_Hz": 10.0, "unit": "N", "peak": peak, "minor": minor,
        "motion": motion, "direction_deg": direction,
    }  # fmt: skip


def _stage(number: str, acting: list[dict[str, Any]], left: list[dict[str, Any]] | None, **more: Any) -> Stage:
    words = {
        "title": "first-order forces of masses that turn", "quantity": "peak force", "formula": "|A1|", "value": 1.0,
        "unit": "N", "plane": "any", "frequency": "n (10 Hz)", "balanceable": "partly", "remaining": None,
    }  # fmt: skip
    return Stage.model_validate({"stage": number, **words, "acting": acting, "left": left, **more})


_IRON = [
    dict(zip(("position_m", "rotating_x_kg_m", "rotating_y_kg_m", "reciprocating_x_kg_m", "reciprocating_y_kg_m"),
             values, strict=True))
    for values in ((-0.2, 1.0, 0.5, -2.0, 0.3), (0.3, -0.7, 0.01, 0.02, 0.03))
]  # fmt: skip


def _scheme(plan: ReciprocatingMachine = _MACHINE) -> Drawing:
    ellipse, fixed = _acting("ellipse", 25.0, 900.0, 300.0), _acting("fixed", 60.0, 700.0)
    stages = [
        _stage("I", [_acting("with_shaft", 40.0, 1000.0, 1000.0)], [_acting("none", None, 0.0)]),
        _stage("II", [_acting("against_shaft", 130.0, 800.0, 800.0)], None),
        _stage("III", [ellipse], [_acting("fixed", 60.0, 30.0)]),
        _stage("IV", [fixed], [_acting("ellipse", 100.0, 500.0, 80.0, 2)]),
        _stage("V", [], []),
        _stage("VII", [], None, iron=_IRON),
        _stage("VIII", [fixed, _acting("none", None, 0.0)], [ellipse, _acting("with_shaft", 12.34, 5.0, 5.0, 2)]),
        _stage("VIII", [fixed], None),
        _stage("VII", [], None),
    ]
    return stage_scheme(plan, stages)


def _indicated(cylinders: int) -> list[Drawing]:
    def chamber(cylinder: int, side: str, name: str | None) -> dict[str, Any]:
        pressure = [1e5 * (2.0 + math.sin(math.radians(at) + cylinder)) for at in _TURN]
        return {
            "side": side, "cylinder": cylinder, "name": name, "pressure_Pa": pressure, "force_N": pressure,
            "suction_opens_deg": 30.0, "discharge_opens_deg": 290.0, "indicated_work_J": 100.0,
        }  # fmt: skip

    chambers = [chamber(n, side, (None, "low")[n]) for n in range(cylinders) for side in ("head", "crank")]
    travel = [0.11 * (1.0 - math.cos(math.radians(at))) for at in _TURN]
    rows = [
        {
            "throw": 0,
            "row": n,
            "name": None,
            "chambers": some,
            "displacement_m": travel,
            "force_N": travel,
            "indicated_power_W": 1.0,
        }
        for n, some in enumerate((chambers, []))
    ]
    return list(indicators(_MACHINE, Gas.model_validate({"angle_deg": _TURN, "rows": rows, "indicated_power_W": 1.0})))


_ELLIPSES = [charts.before(4.1e4, 1e4, 20.0), charts.after("with", 2.2e4, 0.0, 110.0), charts.floor(1.5e4)]
_STYLE = PictureStyle(width_px=1000, transparent=False, title="A title that is too long for a drawing of its width")


def _titled() -> Drawing:
    inner = Drawing(200.0, 100.0, "nothing")
    inner.text((3.0, 4.0), "x", halo=True)
    return styled(inner, _STYLE)


def _crowd() -> Drawing:
    many = [math.sin(0.01 * k) * (k % 7) for k in range(3000)]
    return charts.chart("many", "m", "place, m", list(map(float, range(3000))), [charts.Line("one", many)])


_DRAWN: Mapping[str, Callable[[], str]] = {
    "over a turn": lambda: charts.over_turn("torque", "N m", _TURN, _waves(3e4, 1e4)).svg(),
    "over two turns": lambda: charts.over_turn("a", "N", [20.0 * k for k in range(36)], _waves(3.0)).svg(),
    "many lines": lambda: charts.chart("load", "N", "z, m", [k / 9 for k in range(36)], _waves(*9 * [5e6])).svg(),
    "one of nothing": lambda: charts.chart("load", "N", "z, m", [0.0], [charts.Line("a", [0.0])]).svg(),
    "thousands of points": lambda: _crowd().svg(),
    "hodograph": lambda: charts.hodograph("force", "N", [*_ELLIPSES, charts.as_built(9e3, 2e3, 70.0)]).svg(),
    "hodograph of little": lambda: charts.hodograph("m", "N m", [charts.after("with", 1.0, 0.5, 0.0)], 900.0).svg(),
    "locus": lambda: locus("load", "N", [_loop(3e3 - 2e4j, 6e3), _loop(-1e4 + 1e3j, 2e3)]).svg(),
    "locus of a point": lambda: locus("load", "N", [Curve("A", [0j], 0j, 0.0, SERIES[0])]).svg(),
    "designs": lambda: _designs(60).svg(),
    "one design": lambda: _designs(1).svg(),
    "ladder": _ladder,
    "scheme": lambda: _scheme().svg(),
    "scheme, ccw": lambda: _scheme(_MACHINE.model_copy(update={"rotation": "ccw"})).svg(),
    "indicator": lambda: beside("rows", _indicated(1)).svg(),
    "indicator of several": lambda: beside("rows", 2 * _indicated(2)).svg("sans-serif"),
    "with a title": lambda: _titled().svg(),
}
NAMES = tuple(_DRAWN)


def written(name: str) -> list[str]:
    """The lines of a picture in the table."""
    return [f"{name}: {shape}" for shape in shapes(_DRAWN[name]())]


if __name__ == "__main__":
    sys.stdout.writelines(f"{line}\n" for name in sys.argv[1:] or NAMES for line in written(name))
