"""From a request and its simulation to counterweights, and what is proven of them."""
