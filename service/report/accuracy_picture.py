"""Error against time, method by method, with the frontier: a picture for the command line and the documents.

matplotlib is needed by nothing else in the package: it comes with the extra ``pictures``.
"""

from collections.abc import Callable
from io import StringIO
from itertools import groupby

from schemas.request.accuracy import AccuracyAnswer, AccuracyRow, ChoiceRow
from service.report.chapters.accuracy import method_name

#: distinct for the colour-blind as well
_COLOURS = ("#000000", "#0072b2", "#56b4e9", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#882255")
_MARKS = ("*", "o", "s", "^", "D", "v", "P", "X")


class NoMatplotlib(RuntimeError):
    """A picture was asked for, and there is nothing to draw it with."""

    def __init__(self) -> None:
        super().__init__("a picture needs the extra `pictures`: pip install '.[pictures]' beside pyproject.toml")


def artist() -> Callable[[str, AccuracyAnswer], str]:
    """What draws an answer.

    Raises
    ------
    NoMatplotlib
        if matplotlib is not installed.
    """
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        raise NoMatplotlib from None
    return draw


def draw(title: str, answer: AccuracyAnswer) -> str:
    """The picture as SVG; errors below the resolution are drawn there.

    Raises
    ------
    NoMatplotlib
        if matplotlib is not installed.
    """
    artist()
    from matplotlib import rc_context
    from matplotlib.backends.backend_svg import FigureCanvasSVG
    from matplotlib.figure import Figure

    resolution = answer.reference.resolution if answer.reference else 0.0

    ladder: tuple[AccuracyRow | ChoiceRow, ...] = answer.choices_ladder or answer.ladder

    def place(row: AccuracyRow | ChoiceRow) -> tuple[float, float] | None:
        if row.time_ms is None or row.relative_error is None:
            return None
        return row.time_ms, max(row.relative_error, resolution)

    with rc_context({"svg.hashsalt": "counterweight", "font.family": "sans-serif", "svg.fonttype": "none"}):
        figure = Figure(figsize=(9, 5.6), layout="constrained")
        FigureCanvasSVG(figure)
        axis = figure.add_subplot()
        axis.set(xscale="log", yscale="log", xlabel="time of one solve [ms]", ylabel="true relative error")
        axis.set_title(title, loc="left")
        axis.grid(alpha=0.3, linewidth=0.4)
        for n, (method, rows) in enumerate(groupby(ladder, key=lambda row: row.method)):
            shown = [(row, at) for row in rows if (at := place(row)) is not None]
            if not shown:
                continue
            times, errors = zip(*(at for _, at in shown), strict=True)
            colour = _COLOURS[n % len(_COLOURS)]
            mark = _MARKS[n % len(_MARKS)]
            axis.plot(times, errors, marker=mark, color=colour, linewidth=0.8, markersize=6, label=method_name(method))
            for row, at in shown:
                axis.annotate(
                    row.setting.split()[0] if row.setting[0].isdigit() else row.setting.split()[-1],
                    at,
                    textcoords="offset points",
                    xytext=(5, 4),
                    fontsize=7,
                    color=colour,
                )
        best = sorted(at for row in ladder if row.on_frontier and (at := place(row)) is not None)
        if best:
            times, errors = zip(*best, strict=True)
            axis.step(times, errors, where="post", color="#7f7f7f", linewidth=6, alpha=0.3, label="frontier", zorder=0)
        if answer.reference is not None:
            axis.axhline(resolution, color="#7f7f7f", linestyle=":", linewidth=1, label="errors are known to here")
        if axis.get_legend_handles_labels()[0]:
            axis.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), fontsize=8, frameon=False)
        drawn = StringIO()
        figure.savefig(drawn, format="svg", metadata={"Date": None, "Creator": None})
    return drawn.getvalue()
