"""What crosses a boundary: frozen pydantic models with the unit of every field in its name."""
