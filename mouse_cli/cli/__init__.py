"""The command line: the only place that prints and exits. One file in `commands` is one command."""
