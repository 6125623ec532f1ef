"""The loads on the anti-rotation pins of an orbiting scroll: request, answer, and what both share."""
