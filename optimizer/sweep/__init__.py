"""Sweeps: thousands to millions of designs of one machine, as columns from the axes to the table."""

from optimizer.sweep.chunk import run_chunk
from optimizer.sweep.plan import Plan, plan
from optimizer.sweep.reduce import ParetoFilter, Reducer, Top, reducer

__all__ = ["ParetoFilter", "Plan", "Reducer", "Top", "plan", "reducer", "run_chunk"]
