"""Sweeps: thousands to millions of designs of one machine, as columns from the axes to the table."""

from optimizer.studies.sweep.chunk import run_chunk
from optimizer.studies.sweep.plan import Plan, plan
from optimizer.studies.sweep.reduce import ParetoFilter, Reducer, Top, reducer

__all__ = ["ParetoFilter", "Plan", "Reducer", "Top", "plan", "reducer", "run_chunk"]
