"""From a machine definition to certified counterweights."""
