"""The way into the compiled kernel: arrays in, arrays out, and its statuses as sentences.

It uses the tables that `compile` makes and what turns their numbers back into words.  `sweep`, `pictures`,
`report` and the top run scenes with it.
"""
