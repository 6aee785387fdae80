"""The jig for a 3D printer."""
