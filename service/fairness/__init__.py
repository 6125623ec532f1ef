"""What clients share, and how much of it each may have, so that the legal traffic of one harms nobody else."""
