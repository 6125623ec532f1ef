"""What watches the service: log, metrics, traces, readiness."""
