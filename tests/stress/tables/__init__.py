"""Tables of the kernel changed at random: models of the studies, for the program in tests/kernel/tables/."""
