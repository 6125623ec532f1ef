"""What is often all that is missing: points that are looked at again, and what then counts as certified."""

import numpy as np
import pytest

from optimizer.program.methods.polish import polished
from optimizer.program.methods.single import StagePair, Target, interior_point
from optimizer.program.verdict import yardstick
from tests.program.cases import random_statement


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("least_mass", [True, False])
def test_what_is_good_enough_is_certified_and_what_is_not_is_not(seed: int, least_mass: bool) -> None:
    """The mass counts where it is to be the least, and not else."""
    program = random_statement(seed, "sum", (1.0, 1.0), False, False, False, webs=4)
    share = 1e-6 * float(yardstick(program))
    target = Target(share, share, least_mass)
    pair = interior_point(program, target)
    assert pair.certified
    again = polished(program, target, pair._replace(certified=False), None)
    assert again.certified
    assert again.smallest.gap <= pair.smallest.gap
    assert again.lightest.mass <= pair.lightest.mass
    # at rest nothing is as small as can be
    rest = pair.smallest.with_point(program, np.zeros(4, complex))
    assert not polished(program, target, StagePair(rest, rest, False), None).certified
