"""What an answer holds: counterweights with their proof, and the outputs that a request may ask for."""
