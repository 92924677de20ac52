"""`python -m mouse_cli` is the same as `mouse`."""

from mouse_cli.cli.main import main

if __name__ == "__main__":
    main()
