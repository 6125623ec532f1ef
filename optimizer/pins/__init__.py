"""Anti-rotation pins of a scroll: loads, shapes of the torque, contact with clearance, and the answer."""
