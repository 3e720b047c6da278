"""A display without a screen, for tests of the viewer."""

import os
import select
import shutil
import socket
import subprocess


def start_display(size="1400x1000"):
    """Starts Xvfb on a number that it finds free: the process, and the number. The caller ends it."""
    assert shutil.which("Xvfb"), "Xvfb is missing: apt-get install xvfb"
    for _ in range(5):  # two that start at the same moment may choose the same number
        read, write = os.pipe()
        server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", size + "x24", "-nolisten", "tcp",
             "-noreset"],
            pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write)
        # To the end of the line: the server dies if it cannot finish writing it.
        said = b""
        while not said.endswith(b"\n") and select.select([read], [], [], 60)[0]:
            more = os.read(read, 16)
            if not more:
                break
            said += more
        os.close(read)
        number = said.decode().strip()
        if number and _answers(number) and server.poll() is None:
            return server, number
        server.kill()
        server.wait()
    raise RuntimeError("Xvfb does not start")


def _answers(number):
    with socket.socket(socket.AF_UNIX) as client:
        try:
            client.connect("/tmp/.X11-unix/X" + number)
        except OSError:
            return False
    return True
