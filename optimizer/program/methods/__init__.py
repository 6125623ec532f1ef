"""How one program, or many of one shape, are solved, and what is tried when."""
