"""Four quarters of the slots: what comes near to a point where no tree proves more."""

from itertools import count

import numpy as np
import pytest

from optimizer.choices.catalogue_options import stock
from optimizer.choices.clock import Clock
from optimizer.choices.discrete.exchange import neighbourhoods, start
from optimizer.choices.discrete.options import EQUAL, Incumbent
from optimizer.choices.discrete.quarters import quarters
from schemas.request.requests import OptimizeRequest
from tests.benchmarks.discrete import choice
from tests.choices.any_mass import of_any_mass
from tests.night import every
from tests.verification.checking import optimized


@pytest.mark.nightly
def test_what_no_tree_closes_is_found_to_a_ten_thousandth() -> None:
    """Regression: 32 webs whose options reach the floor, 10^32 sets; few slots with all options left 4e-4."""
    body = choice(32, None, 5)
    body["accuracy"] = {"relative_gap": 1e-4, "time_limit_s": 30}
    answer = optimized(body)
    assert answer.status == "optimal"
    assert answer.certificate is not None
    assert answer.certificate.lower_bound is not None
    # analytic: nothing is below what turns against the shaft
    assert answer.residual.after is not None
    floor = answer.floor.force_N + answer.floor.moment_Nm / 4.7
    assert answer.certificate.lower_bound == pytest.approx(floor, rel=1e-6)
    assert 0 <= answer.certificate.objective - floor <= 1e-4 * answer.certificate.yardstick


@pytest.mark.parametrize("limits", every(3, [{"max_counterweights": 31}, {}, {"max_total_mass_kg": 60.0}]))
def test_it_keeps_the_limits_and_is_never_worse(limits: dict[str, float]) -> None:
    body = choice(32, None, 5)
    body["machine"] |= limits
    request = OptimizeRequest.model_validate(body)
    best, _ = of_any_mass(request)
    problem, options = best.program.subset(0), stock(request.machine).options

    def outcome() -> tuple[float, Incumbent]:
        incumbent = Incumbent(problem, options, EQUAL * float(problem.at_rest))
        start(incumbent, best.optima.unbalance[:1])
        neighbourhoods(incumbent, best.optima.unbalance[0], 1, lambda: False, Clock(3600.0))
        before, looks = incumbent.least, count(0.0)
        # a second passes from look to look: one round
        quarters(incumbent, lambda: False, Clock(1.5, lambda: next(looks)))
        return before, incumbent

    before, incumbent = outcome()
    assert incumbent.selection is not None
    assert incumbent.least < before if not limits else incumbent.least <= before
    assert incumbent.least == float(problem.objective(options.carried(incumbent.selection)))
    assert bool(options.counts(problem, incumbent.selection))
    assert np.array_equal(incumbent.selection, outcome()[1].selection)
