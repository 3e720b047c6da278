#include "apps/viewer/portal.h"

#include <dbus/dbus.h>
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>

#include "lambent/file/file_uri.h"

namespace lambent::viewer {

namespace {

using How = FileAnswer::How;
using Clock = std::chrono::steady_clock;

constexpr const char* kPortal = "org.freedesktop.portal.Desktop";
constexpr const char* kObject = "/org/freedesktop/portal/desktop";
constexpr const char* kChooser = "org.freedesktop.portal.FileChooser";
constexpr const char* kRequest = "org.freedesktop.portal.Request";
/// How long a stop, or a wait that is over, may go unseen.
constexpr int kTickMilliseconds = 50;
/// The bus and the portal answer at once; a portal that the bus has to start first takes seconds. How
/// long a person takes to choose is their own affair.
constexpr std::chrono::seconds kPatience(10);

struct Unref {
  void operator()(DBusMessage* message) const { dbus_message_unref(message); }
  void operator()(DBusConnection* connection) const {
    dbus_connection_close(connection);
    dbus_connection_unref(connection);
  }
};
using Message = std::unique_ptr<DBusMessage, Unref>;
using Connection = std::unique_ptr<DBusConnection, Unref>;

FileAnswer noDialog(std::string why) {
  return {How::NoDialog, {}, std::move(why)};
}
FileAnswer failed(std::string why) {
  return {How::Failed, {}, std::move(why)};
}

/// As the specification of D-Bus and systemd have it. Nothing: there is none. No bus is started for
/// the purpose, as libdbus would: it has no portal.
std::optional<std::string> busAddress() {
  if (const char* given = std::getenv("DBUS_SESSION_BUS_ADDRESS"); given && *given) return given;
  const char* folder = std::getenv("XDG_RUNTIME_DIR");
  if (!folder || !*folder) return std::nullopt;
  const std::filesystem::path socket = std::filesystem::path(folder) / "bus";
  std::error_code ignored;
  if (!std::filesystem::is_socket(socket, ignored)) return std::nullopt;
  char* escaped = dbus_address_escape_value(socket.c_str());
  if (!escaped) return std::nullopt;
  std::string address = std::string("unix:path=") + escaped;
  dbus_free(escaped);
  return address;
}

/// Writes a message's arguments. libdbus fails only where memory is short: then it says so at the end.
class Writer {
 public:
  explicit Writer(DBusMessage* message) { dbus_message_iter_init_append(message, &at_); }

  void text(const char* value) { basic(DBUS_TYPE_STRING, &value); }
  void text(const std::string& value) { text(value.c_str()); }
  void number(dbus_uint32_t value) { basic(DBUS_TYPE_UINT32, &value); }
  void boolean(bool value) {
    const dbus_bool_t word = value;
    basic(DBUS_TYPE_BOOLEAN, &word);
  }
  void inside(int type, const char* signature, const std::function<void(Writer&)>& write) {
    Writer inner(whole_);
    if (!whole_ || !dbus_message_iter_open_container(&at_, type, signature, &inner.at_)) {
      whole_ = false;
      return;
    }
    write(inner);
    whole_ = dbus_message_iter_close_container(&at_, &inner.at_) && inner.whole_;
  }
  void array(const char* signature, const std::function<void(Writer&)>& write) {
    inside(DBUS_TYPE_ARRAY, signature, write);
  }
  void structure(const std::function<void(Writer&)>& write) {
    inside(DBUS_TYPE_STRUCT, nullptr, write);
  }
  /// An entry of a{sv}.
  void option(const char* name, const char* signature, const std::function<void(Writer&)>& write) {
    inside(DBUS_TYPE_DICT_ENTRY, nullptr, [&](Writer& entry) {
      entry.text(name);
      entry.inside(DBUS_TYPE_VARIANT, signature, write);
    });
  }
  /// The bytes of a path with a zero at their end.
  void bytes(const std::string& path) {
    const char* data = path.c_str();
    array("y", [&](Writer& inner) {
      inner.whole_ = inner.whole_ && dbus_message_iter_append_fixed_array(
                                         &inner.at_, DBUS_TYPE_BYTE, &data, int(path.size() + 1));
    });
  }
  bool whole() const { return whole_; }

 private:
  explicit Writer(bool whole) : whole_(whole) {}
  void basic(int type, const void* value) {
    whole_ = whole_ && dbus_message_iter_append_basic(&at_, type, value);
  }

  DBusMessageIter at_;
  bool whole_ = true;
};

/// "*.[gG][lL][bB]": patterns of the portal tell cases apart.
std::string patternOf(const std::string& extension) {
  std::string pattern = "*";
  for (const char c : extension) {
    const bool letter = c >= 'a' && c <= 'z';
    if (letter)
      pattern += {'[', c, char(c - 'a' + 'A'), ']'};
    else
      pattern += c;
  }
  return pattern;
}

void writeKind(Writer& to, const FileKind& kind) {
  to.structure([&](Writer& pair) {
    pair.text(kind.name);
    pair.array("(us)", [&](Writer& patterns) {
      const auto pattern = [&](const std::string& text) {
        patterns.structure([&](Writer& each) {
          each.number(0);  // a pattern of names, not a MIME type
          each.text(text);
        });
      };
      if (kind.extensions.empty()) pattern("*");
      for (const std::string& extension : kind.extensions) pattern(patternOf(extension));
    });
  });
}

Message callFor(const FileQuestion& question, const std::string& window, const std::string& token) {
  Message call(dbus_message_new_method_call(kPortal, kObject, kChooser,
                                            question.saves() ? "SaveFile" : "OpenFile"));
  if (!call) return nullptr;
  const auto kinds = kindsOf(question.what);
  Writer arguments(call.get());
  arguments.text(window);
  arguments.text(titleOf(question.what));
  arguments.array("{sv}", [&](Writer& options) {
    options.option("handle_token", "s", [&](Writer& to) { to.text(token); });
    options.option("modal", "b", [&](Writer& to) { to.boolean(true); });
    options.option("filters", "a(sa(us))", [&](Writer& to) {
      to.array("(sa(us))", [&](Writer& list) {
        for (const FileKind& kind : kinds) writeKind(list, kind);
      });
    });
    options.option("current_filter", "(sa(us))", [&](Writer& to) { writeKind(to, kinds.front()); });
    // What is no UTF-8 cannot be sent.
    if (question.saves() && dbus_validate_utf8(question.name.c_str(), nullptr))
      options.option("current_name", "s", [&](Writer& to) { to.text(question.name); });
    if (!question.folder.empty())
      options.option("current_folder", "ay",
                     [&](Writer& to) { to.bytes(question.folder.string()); });
  });
  return arguments.whole() ? std::move(call) : nullptr;
}

bool isSignal(DBusMessage* message, const char* interface, const char* name) {
  return dbus_message_is_signal(message, interface, name);
}

/// The texts of an array of them, from a variant; nothing if it is another thing.
std::optional<std::vector<std::string>> textsOf(DBusMessageIter* variant) {
  if (dbus_message_iter_get_arg_type(variant) != DBUS_TYPE_VARIANT) return std::nullopt;
  DBusMessageIter list, each;
  dbus_message_iter_recurse(variant, &list);
  if (dbus_message_iter_get_arg_type(&list) != DBUS_TYPE_ARRAY ||
      dbus_message_iter_get_element_type(&list) != DBUS_TYPE_STRING)
    return std::nullopt;
  std::vector<std::string> texts;
  for (dbus_message_iter_recurse(&list, &each);
       dbus_message_iter_get_arg_type(&each) == DBUS_TYPE_STRING; dbus_message_iter_next(&each)) {
    const char* text = nullptr;
    dbus_message_iter_get_basic(&each, &text);
    texts.emplace_back(text);
  }
  return texts;
}

/// What a Response says: (u response, a{sv} results), with the chosen files under "uris".
FileAnswer answerOf(DBusMessage* response) {
  if (!dbus_message_has_signature(response, "ua{sv}"))
    return failed("the desktop's file dialog gave an answer of another form");
  DBusMessageIter at, results;
  dbus_message_iter_init(response, &at);
  dbus_uint32_t code = 0;
  dbus_message_iter_get_basic(&at, &code);
  if (code == 1) return {How::Cancelled, {}, {}};
  if (code != 0) return failed("the desktop ended its file dialog");
  dbus_message_iter_next(&at);
  for (dbus_message_iter_recurse(&at, &results);
       dbus_message_iter_get_arg_type(&results) == DBUS_TYPE_DICT_ENTRY;
       dbus_message_iter_next(&results)) {
    DBusMessageIter entry;
    dbus_message_iter_recurse(&results, &entry);
    const char* name = nullptr;
    dbus_message_iter_get_basic(&entry, &name);
    if (std::string_view(name) != "uris") continue;
    dbus_message_iter_next(&entry);
    const auto uris = textsOf(&entry);
    if (!uris || uris->empty()) break;
    const auto path = file::pathOfUri(uris->front());
    return path ? FileAnswer{How::Chosen, *path, {}} : failed(path.error().message);
  }
  return failed("the desktop's file dialog named no file");
}

/// One question on a connection of its own.
class Conversation {
 public:
  Conversation(Connection connection, std::stop_token stop)
      : connection_(std::move(connection)), stop_(std::move(stop)) {}

  FileAnswer ask(const FileQuestion& question, const std::string& window);

 private:
  struct Reply {
    Message message;    ///< null: none came
    FileAnswer answer;  ///< then this is why
  };
  /// Sends a call and waits for its reply; other messages meanwhile are kept for next().
  Reply call(DBusMessage* call);
  /// The next message, or null when a tick has passed without one.
  Message next();
  bool lost(DBusMessage* message) const {
    return isSignal(message, DBUS_INTERFACE_LOCAL, "Disconnected");
  }
  Status listen();
  FileAnswer waitForResponse(const std::string& handle, const std::string& portal);
  void close(const std::string& handle);

  Connection connection_;
  std::stop_token stop_;
  std::vector<Message> kept_;
};

Message Conversation::next() {
  if (Message message{dbus_connection_pop_message(connection_.get())}) return message;
  dbus_connection_read_write(connection_.get(), kTickMilliseconds);
  return Message(dbus_connection_pop_message(connection_.get()));
}

Conversation::Reply Conversation::call(DBusMessage* call) {
  dbus_uint32_t serial = 0;
  if (!dbus_connection_send(connection_.get(), call, &serial))
    return {nullptr, noDialog("the session bus takes no message")};
  const auto until = Clock::now() + kPatience;
  while (Clock::now() < until) {
    if (stop_.stop_requested()) return {nullptr, {How::Cancelled, {}, {}}};
    Message message = next();
    if (!message) continue;
    if (lost(message.get())) return {nullptr, noDialog("the session bus went away")};
    if (dbus_message_get_reply_serial(message.get()) != serial) {
      kept_.push_back(std::move(message));
      continue;
    }
    const char* name = dbus_message_get_error_name(message.get());
    if (!name) return {std::move(message), {}};
    const std::string_view error = name;
    const bool none = error == DBUS_ERROR_SERVICE_UNKNOWN ||
                      error == DBUS_ERROR_NAME_HAS_NO_OWNER || error == DBUS_ERROR_UNKNOWN_METHOD ||
                      error == DBUS_ERROR_UNKNOWN_INTERFACE || error == DBUS_ERROR_UNKNOWN_OBJECT;
    if (none) return {nullptr, noDialog("there is no desktop portal for it (xdg-desktop-portal)")};
    if (error == DBUS_ERROR_NO_REPLY) break;
    return {nullptr, noDialog(fmt::format("the desktop portal refuses it ({})", error))};
  }
  return {nullptr, noDialog("the desktop portal does not answer")};
}

/// To what the portal says of its requests, and to its going away.
Status Conversation::listen() {
  for (const std::string& rule :
       {fmt::format("type='signal',sender='{}',interface='{}',member='Response'", kPortal,
                    kRequest),
        fmt::format("type='signal',sender='{0}',interface='{0}',member='NameOwnerChanged',"
                    "arg0='{1}'",
                    DBUS_INTERFACE_DBUS, kPortal)}) {
    const Message add(dbus_message_new_method_call(DBUS_SERVICE_DBUS, DBUS_PATH_DBUS,
                                                   DBUS_INTERFACE_DBUS, "AddMatch"));
    if (!add) return report::failed("not enough memory");
    Writer(add.get()).text(rule);
    if (const Reply reply = call(add.get()); !reply.message)
      return report::failed(reply.answer.text);
  }
  return Status::ok();
}

FileAnswer Conversation::ask(const FileQuestion& question, const std::string& window) {
  const Message hello(dbus_message_new_method_call(DBUS_SERVICE_DBUS, DBUS_PATH_DBUS,
                                                   DBUS_INTERFACE_DBUS, "Hello"));
  if (!hello) return noDialog("not enough memory");
  if (const Reply reply = call(hello.get()); !reply.message) return reply.answer;
  if (Status heard = listen(); !heard)
    return stop_.stop_requested() ? FileAnswer{} : noDialog(heard.error().message);

  // The connection is this question's alone: one token will do.
  const Message open = callFor(question, window, "lambent");
  if (!open) return noDialog("not enough memory");
  const Reply reply = call(open.get());
  if (!reply.message) return reply.answer;
  const char* handle = nullptr;
  if (!dbus_message_get_args(reply.message.get(), nullptr, DBUS_TYPE_OBJECT_PATH, &handle,
                             DBUS_TYPE_INVALID))
    return failed("the desktop portal gave an answer of another form");
  const char* portal = dbus_message_get_sender(reply.message.get());
  return waitForResponse(handle, portal ? portal : "");
}

FileAnswer Conversation::waitForResponse(const std::string& handle, const std::string& portal) {
  for (;;) {
    if (stop_.stop_requested()) {
      close(handle);
      return {};
    }
    Message message;
    if (kept_.empty()) {
      message = next();
    } else {
      message = std::move(kept_.front());
      kept_.erase(kept_.begin());
    }
    if (!message) continue;
    if (lost(message.get())) return failed("the session bus went away with the file dialog");
    const char* sender = dbus_message_get_sender(message.get());
    const char* path = dbus_message_get_path(message.get());
    // Only the portal that took the question may answer it.
    if (isSignal(message.get(), kRequest, "Response") && sender && portal == sender && path &&
        handle == path)
      return answerOf(message.get());
    const char *name = nullptr, *before = nullptr, *after = nullptr;
    if (isSignal(message.get(), DBUS_INTERFACE_DBUS, "NameOwnerChanged") && sender &&
        std::string_view(sender) == DBUS_SERVICE_DBUS &&
        dbus_message_get_args(message.get(), nullptr, DBUS_TYPE_STRING, &name, DBUS_TYPE_STRING,
                              &before, DBUS_TYPE_STRING, &after, DBUS_TYPE_INVALID) &&
        std::string_view(name) == kPortal && before == portal)
      return failed("the desktop portal went away with its file dialog");
  }
}

void Conversation::close(const std::string& handle) {
  const Message message(dbus_message_new_method_call(kPortal, handle.c_str(), kRequest, "Close"));
  if (!message) return;
  dbus_message_set_no_reply(message.get(), true);
  if (!dbus_connection_send(connection_.get(), message.get(), nullptr)) return;
  // Once is enough for so short a message, and nothing holds up the window that closes.
  dbus_connection_read_write(connection_.get(), 0);
}

}  // namespace

FileAnswer askPortal(const FileQuestion& question, const std::string& window,
                     std::stop_token stop) {
  const auto address = busAddress();
  if (!address) return noDialog("there is no session bus");
  DBusError error = DBUS_ERROR_INIT;
  Connection connection(dbus_connection_open_private(address->c_str(), &error));
  if (!connection) {
    std::string why = error.message ? error.message : "no reason given";
    dbus_error_free(&error);
    return noDialog(fmt::format("there is no session bus ({})", why));
  }
  dbus_connection_set_exit_on_disconnect(connection.get(), false);
  return Conversation(std::move(connection), std::move(stop)).ask(question, window);
}

}  // namespace lambent::viewer
