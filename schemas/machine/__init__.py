"""The machine of a request: shaft, throws, rows, webs, and the catalogue of its counterweights."""
