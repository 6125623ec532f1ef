"""Draw the pictures of the documentation: ``python docs/pictures.py``."""

import json
from pathlib import Path

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams["svg.hashsalt"] = "counterweight"
matplotlib.rcParams["font.family"] = "sans-serif"

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

from optimizer.optimize import optimize  # noqa: E402
from schemas.request.requests import OptimizeRequest  # noqa: E402
from service.report import pictures  # noqa: E402

DOCS = Path(__file__).parent
BEFORE, AFTER, FLOOR = "#d55e00", "#0072b2", "#7f7f7f"  # distinct for the colour-blind as well


def hodographs(name: str) -> None:
    """Force and moment of an example over a turn, before and after, with the floor."""
    body = json.loads((DOCS.parent / "examples" / f"{name}.json").read_bytes())
    body["outputs"] = ["residual", "hodograph"]
    answer = optimize(OptimizeRequest.model_validate(body))
    assert answer.hodograph is not None
    assert answer.hodograph.after is not None
    figure, axes = plt.subplots(1, 2, figsize=(9, 4.2), layout="constrained")
    turn = np.linspace(0, 2 * np.pi, 361)
    for axis, kind, unit, floor in (
        (axes[0], "force", "N", answer.floor.force_N),
        (axes[1], "moment", "Nm", answer.floor.moment_Nm),
    ):
        for state, colour, label in (
            (answer.hodograph.before, BEFORE, "before"),
            (answer.hodograph.after, AFTER, "after"),
        ):
            x = np.array(getattr(state, f"{kind}_x_{unit}")) / 1e3
            y = np.array(getattr(state, f"{kind}_y_{unit}")) / 1e3
            axis.plot(np.append(x, x[0]), np.append(y, y[0]), color=colour, linewidth=2, label=label)
        axis.plot(floor * np.cos(turn) / 1e3, floor * np.sin(turn) / 1e3, ":", color=FLOOR, label="floor")
        axis.set_aspect("equal", adjustable="datalim")
        axis.set_title(f"first-order {kind} over a turn")
        axis.set_xlabel(f"x [k{unit.replace('Nm', 'N m')}]")
        axis.set_ylabel(f"y [k{unit.replace('Nm', 'N m')}]")
        axis.grid(alpha=0.3)
    axes[0].legend(loc="upper right")
    figure.suptitle(f"{answer.total_mass_kg:.1f} kg on four webs of the {body['machine']['name']}")
    figure.savefig(DOCS / f"{name}-hodograph.svg", metadata={"Date": None, "Creator": None})


def side(name: str) -> None:
    """An example from the side with its best counterweights, as in its report."""
    request = OptimizeRequest.model_validate_json((DOCS.parent / "examples" / f"{name}.json").read_bytes())
    (DOCS / f"{name}-side.svg").write_bytes(pictures.svg(pictures.side(request)))


if __name__ == "__main__":
    hodographs("2d12")
    for example in ("2d12", "inline-four-engine", "scroll-three-pins"):
        side(example)
