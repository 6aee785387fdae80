"""Many pieces at once; see README.md."""
