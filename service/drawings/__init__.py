"""Drawings of counterweights for a workshop and for other CAD: outlines, sheets, solids, bills of material."""
