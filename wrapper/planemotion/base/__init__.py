"""What everything may raise, and the versions of what computes: errors and versions.

This room uses nothing but the standard library and the compiled kernel's own version.  Every room uses it.
"""
