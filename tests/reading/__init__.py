"""What is said of scenes that are wrong."""
