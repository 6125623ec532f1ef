"""Options on some webs, and any mass at any angle on the others: the best of both together, with a bound of all."""
