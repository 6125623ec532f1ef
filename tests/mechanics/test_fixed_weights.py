"""Arrays of weights behind others, over leading axes."""

import numpy as np

from optimizer.numerics.arrays import side_by_side


def test_weights_stand_behind_others_in_every_design() -> None:
    """Analytic: whichever of both has the leading axes."""
    many, few = np.arange(24.0).reshape(2, 3, 4), np.array([-1.0, -2.0])
    side = side_by_side(many, few)
    assert side.shape == (2, 3, 6)
    assert side[1, 2].tolist() == [20.0, 21.0, 22.0, 23.0, -1.0, -2.0]
    turned = side_by_side(few, many)
    assert turned.shape == (2, 3, 6)
    assert turned[0, 1].tolist() == [-1.0, -2.0, 4.0, 5.0, 6.0, 7.0]
    assert side_by_side(few, few).tolist() == [-1.0, -2.0, -1.0, -2.0]
