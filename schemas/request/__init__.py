"""Requests about one machine, and answers that belong to one request alone."""
