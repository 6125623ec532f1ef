"""The trade-off between peak force and peak moment: certified points of the front, from request to answer."""
