"""From responses to figures that an engineer reads."""
