"""Counterweights that are at least so heavy, or not there: the smallest objective, with a bound.

Knows statements and unbalances, and no machines. The way in is :func:`optimizer.choices.semicontinuous.search.search`.
``places.py`` says what a node of the tree leaves every web, ``bound.py`` what multipliers prove of it, and
``inside.py`` searches points that keep all limits (docs/mathematics.md section 20).
"""
