"""Counterweights from what there is: the smallest objective over discrete choices, with a bound.

Knows statements, options and bounds, and no machines. The way in is :func:`optimizer.choices.discrete.search.search`.

Every web is a slot that takes one of its options, the first of which is nothing. Two methods prove: all sums of one
half of the slots beside those of the other (``halves.py``), and a tree whose nodes are bounded by the batch kernel
(``branch.py``). Neighbourhoods (``exchange.py``) find what is to be proven (docs/mathematics.md section 16).
"""
