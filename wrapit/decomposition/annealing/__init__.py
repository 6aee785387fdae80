"""The paper's search."""
