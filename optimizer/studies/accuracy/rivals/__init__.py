"""Other ways to solve the program, for the accuracy ladder only: matrices, sampled angles, polygons."""
