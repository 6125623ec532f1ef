"""What is asked about one machine, and the answers that belong to one request alone."""
