"""What the service computes: all that routes, jobs, documents, OpenAPI, the command line and metrics say of it."""
