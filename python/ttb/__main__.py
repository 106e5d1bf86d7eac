"""``python -m ttb ARGUMENTS``: the program itself, for who has no folder of scripts on the path."""

import os
import signal
import subprocess
import sys

from ._program import program

if __name__ == "__main__":
    command = [str(program()), *sys.argv[1:]]
    if os.name != "nt":
        os.execv(command[0], command)
    # The program hears Ctrl-C itself, and keeps its results; Windows replaces no process by another one.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    sys.exit(subprocess.call(command))
