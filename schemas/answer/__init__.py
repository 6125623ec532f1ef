"""Answers: counterweights with their proof, and the outputs that a request may name."""
