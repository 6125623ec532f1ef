"""What speaks HTTP: server and connections, bodies, checks, errors, computations behind a route."""
