"""The trade-off of responses, of mass, or of the number of counterweights."""
