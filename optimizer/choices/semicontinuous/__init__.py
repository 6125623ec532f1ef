"""Counterweights that are at least so heavy, or not there: the smallest objective, with a bound.

Knows statements and unbalances, and no machines. The way in is :func:`optimizer.choices.semicontinuous.search.search`.
What a
node of the tree leaves every web stands in ``places.py``, what multipliers prove of it in ``bound.py``, and how points
that keep everything are found in ``inside.py`` (docs/mathematics.md section 20).
"""
