"""Pulses and waves that are short beside the run, at random: no answer that is `ok` passes one over."""
