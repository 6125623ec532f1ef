"""Matching: which parts of a set go on which row of a machine."""
