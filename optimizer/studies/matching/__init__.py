"""Which weighed part goes on which row (docs/mathematics.md section 15)."""
