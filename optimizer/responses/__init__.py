"""What a machine answers to unbalance: with a peak in closed form, or over a revolution with a certified one."""
