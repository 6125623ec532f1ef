"""The portal page: what the browser gets."""
