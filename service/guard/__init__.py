"""What guards the service: who asks, how often, how large."""
