"""What is the same in a mirror."""
