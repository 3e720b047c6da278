// What keys do. One table: the keyboard, the help under '?' and the scripts' `key` read it.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "apps/viewer/gl_window.h"
#include "apps/viewer/session.h"

namespace lambent::viewer {

struct Action {
  std::string keys;  ///< as a person writes it: "Shift+E"
  KeyPress press;
  std::string_view group, text;
  std::function<void(Session&, const PixelSize& picture)> run;
};

std::span<const Action> actions();
/// The action of a key, if it has one.
const Action* actionOf(const KeyPress& press);
/// "F", "Shift+E", "Ctrl+S", "Left", "?", in any case.
const Action* actionNamed(std::string_view keys);

}  // namespace lambent::viewer
