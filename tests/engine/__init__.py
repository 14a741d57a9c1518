"""Calls of the kernel: arrays in, answers, errors, histories and finds out."""
