"""`python -m wrapit`."""

from wrapit.cli import main

if __name__ == "__main__":
    main()
