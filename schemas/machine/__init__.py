"""The machine of a request: shaft, throws, rows, webs, and what counterweights are chosen from."""
