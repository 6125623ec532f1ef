"""The interior point: compiled for many programs side by side, and once more in finer numbers."""
