"""What a machine answers to unbalance: with a peak in closed form, or over the whole turn with a certified one."""
