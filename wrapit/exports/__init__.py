"""Writers, one per file format."""
