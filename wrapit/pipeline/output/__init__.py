"""The output folder is the user's: whose files they are, staging, and moving in."""
