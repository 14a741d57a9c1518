"""Laws of mechanics from scenes: what is written means what the kernel does, by closed forms."""
