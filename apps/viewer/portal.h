// The desktop's file dialog, by the XDG desktop portal: org.freedesktop.portal.FileChooser over D-Bus
// (https://flatpak.github.io/xdg-desktop-portal/docs/doc-org.freedesktop.portal.FileChooser.html).
#pragma once

#include <stop_token>
#include <string>

#include "apps/viewer/file_question.h"

namespace lambent::viewer {

/// Asks, and waits until the person has chosen: for a thread of its own. `window` is the window that
/// the dialog belongs to as the portal names it ("x11:1a00007"), or empty. When a stop is requested
/// the dialog is closed, and the answer is Cancelled. NoDialog: this desktop has no bus or no portal,
/// it does not answer, or Lambent was built without libdbus.
FileAnswer askPortal(const FileQuestion& question, const std::string& window, std::stop_token stop);

}  // namespace lambent::viewer
