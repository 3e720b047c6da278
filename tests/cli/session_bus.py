"""A message bus of a test's own, with nothing on it that the test has not put there."""

import select
import shutil
import subprocess

CONFIGURATION = """<!DOCTYPE busconfig PUBLIC "-//freedesktop//DTD D-Bus Bus Configuration 1.0//EN"
 "http://www.freedesktop.org/standards/dbus/1.0/busconfig.dtd">
<busconfig>
  <type>session</type>
  <listen>unix:dir={folder}</listen>
  <policy context="default">
    <allow send_destination="*" eavesdrop="true"/>
    <allow eavesdrop="true"/>
    <allow own="*"/>
  </policy>
</busconfig>
"""


def start_bus(folder):
    """Starts dbus-daemon with its socket in a folder, whose name has to be short: the process, and the
    bus's address. The caller ends it."""
    assert shutil.which("dbus-daemon"), "dbus-daemon is missing: apt-get install dbus-daemon"
    configuration = folder / "bus.conf"
    configuration.write_text(CONFIGURATION.format(folder=folder))
    daemon = subprocess.Popen(
        ["dbus-daemon", "--config-file", str(configuration), "--nofork", "--nopidfile",
         "--print-address=1"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    assert select.select([daemon.stdout], [], [], 60)[0], "dbus-daemon does not start"
    address = daemon.stdout.readline().strip()
    assert address, "dbus-daemon does not start"
    return daemon, address
