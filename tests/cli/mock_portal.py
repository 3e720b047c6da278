#!/usr/bin/python3
"""A desktop portal that has a file dialog but no desktop: it answers as it is told to.

    mock_portal.py LOG BEHAVIOUR [URI…]

Runs until it is ended. Every call is a line of JSON in LOG, and the first line says that it is there.
Behaviours:
  choose          the files are chosen
  cancel          the person does not want to
  end             the dialog is closed by somebody else
  no-files        answers without files
  wrong-form      answers with something else altogether
  refuse          the call is an error
  old-handle      as portals before 0.9: the handle is not the one that was asked for
  others          first answers come from others, and to other requests; then the files are chosen
  never           the dialog stays open
  mute            not even the call is replied to
  vanish          goes away with the dialog open
"""

import json
import os
import sys

import dbus
import dbus.lowlevel
import dbus.mainloop.glib
import dbus.service
from gi.repository import GLib

NAME = "org.freedesktop.portal.Desktop"
OBJECT = "/org/freedesktop/portal/desktop"
REQUEST = "org.freedesktop.portal.Request"


def plain(value):
    """Without the types of D-Bus; arrays of bytes as the text before their zero."""
    if isinstance(value, dbus.Array):
        if value.signature == "y":
            return bytes(value).split(b"\0")[0].decode()
        return [plain(each) for each in value]
    if isinstance(value, dbus.Struct):
        return [plain(each) for each in value]
    if isinstance(value, dbus.Dictionary):
        return {str(key): plain(each) for key, each in value.items()}
    if isinstance(value, dbus.Boolean):
        return bool(value)
    return int(value) if isinstance(value, int) else str(value)


class Portal(dbus.service.Object):
    def __init__(self, bus, log, behaviour, uris):
        super().__init__(bus, OBJECT)
        self.bus, self.log, self.behaviour, self.uris = bus, log, behaviour, uris
        bus.add_message_filter(self.closed)

    def note(self, **what):
        with open(self.log, "a") as file:
            file.write(json.dumps(what) + "\n")

    def closed(self, _, message):
        if message.get_interface() == REQUEST and message.get_member() == "Close":
            self.note(call="Close", handle=message.get_path())
            return dbus.lowlevel.HANDLER_RESULT_HANDLED
        return dbus.lowlevel.HANDLER_RESULT_NOT_YET_HANDLED

    def respond(self, bus, to, handle, *arguments, signature="ua{sv}"):
        signal = dbus.lowlevel.SignalMessage(handle, REQUEST, "Response")
        signal.append(*arguments, signature=signature)
        signal.set_destination(to)
        bus.send_message(signal)
        bus.flush()

    def ask(self, call, window, title, options, sender, reply, error):
        self.note(call=call, window=str(window), title=str(title), options=plain(options))
        parts = (sender[1:].replace(".", "_"), str(options["handle_token"]))
        handle = "/org/freedesktop/portal/desktop/request/{}/{}".format(*parts)
        if self.behaviour == "old-handle":
            handle = OBJECT + "/request/1"
        if self.behaviour == "mute":
            return
        if self.behaviour == "refuse":
            error(dbus.DBusException("not today", name=NAME + ".Error.Failed"))
            return
        reply(dbus.ObjectPath(handle))
        GLib.idle_add(self.answer, sender, handle)

    def answer(self, to, handle):
        chosen = dbus.Dictionary({"uris": dbus.Array(self.uris, signature="s")}, signature="sv")
        nothing = dbus.Dictionary({}, signature="sv")
        if self.behaviour == "others":
            other = dbus.bus.BusConnection(os.environ["DBUS_SESSION_BUS_ADDRESS"])
            lie = dbus.Dictionary({"uris": dbus.Array(["file:///lie"], signature="s")},
                                  signature="sv")
            self.respond(other, to, handle, dbus.UInt32(0), lie)
            other.call_blocking("org.freedesktop.DBus", "/org/freedesktop/DBus",
                                "org.freedesktop.DBus", "GetId", "", ())  # it has been delivered
            self.respond(self.bus, to, handle + "_other", dbus.UInt32(0), lie)
        if self.behaviour in ("choose", "old-handle", "others"):
            self.respond(self.bus, to, handle, dbus.UInt32(0), chosen)
        if self.behaviour == "cancel":
            self.respond(self.bus, to, handle, dbus.UInt32(1), nothing)
        if self.behaviour == "end":
            self.respond(self.bus, to, handle, dbus.UInt32(2), nothing)
        if self.behaviour == "no-files":
            self.respond(self.bus, to, handle, dbus.UInt32(0), nothing)
        if self.behaviour == "wrong-form":
            self.respond(self.bus, to, handle, "ball.glb", signature="s")
        if self.behaviour == "vanish":
            os._exit(0)
        return False

    @dbus.service.method("org.freedesktop.portal.FileChooser", in_signature="ssa{sv}",
                         out_signature="o", sender_keyword="sender",
                         async_callbacks=("reply", "error"))
    def OpenFile(self, window, title, options, sender, reply, error):
        self.ask("OpenFile", window, title, options, sender, reply, error)

    @dbus.service.method("org.freedesktop.portal.FileChooser", in_signature="ssa{sv}",
                         out_signature="o", sender_keyword="sender",
                         async_callbacks=("reply", "error"))
    def SaveFile(self, window, title, options, sender, reply, error):
        self.ask("SaveFile", window, title, options, sender, reply, error)


def main():
    dbus.mainloop.glib.DBusGMainLoop(set_as_default=True)
    bus = dbus.bus.BusConnection(os.environ["DBUS_SESSION_BUS_ADDRESS"])
    portal = Portal(bus, *sys.argv[1:3], sys.argv[3:])
    bus.request_name(NAME)
    portal.note(call="ready")
    GLib.MainLoop().run()


if __name__ == "__main__":
    main()
