"""The command line: one module for each group of commands, put together in `main`.

It uses everything below, imported inside the commands so that --help and a mistyped option answer at once.
Nothing in the package uses it.
"""
