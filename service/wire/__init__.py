"""Connections, and what goes over them, within its times and shares; nothing of jobs and computations."""
