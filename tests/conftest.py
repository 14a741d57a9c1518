"""What all tests share."""

import signal

# A shell lets what it starts in the background ignore Ctrl-C, and so do its children:
# the tests that interrupt would wait.
if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)
