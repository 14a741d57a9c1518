"""Units, addresses and expressions: what is read, what it means, which code it becomes."""
