"""Programs over the whole turn, by outer approximation: cuts, their proof, and the optimum."""
