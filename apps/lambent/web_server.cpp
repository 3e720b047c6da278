// A list of names, and what stands behind each: a request that is not on the list is answered 404,
// whatever it looks like, so there is no path to walk out of. Other pages in the same browser are
// kept out by the Host header (a foreign name that resolves to 127.0.0.1 does not match) and by the
// policies that go with every answer.
//
// Eigen cannot be included beside httplib.h: through resolv.h that makes `_res` a macro.
#include "apps/lambent/web_server.h"

#include <fmt/format.h>
#include <httplib.h>
#include <spawn.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <thread>
#include <vector>

#include "apps/lambent/standard_streams.h"
#include "apps/lambent/web_connections.h"
#include "apps/lambent/web_manifest.h"

namespace lambent::tool {

namespace {

namespace fs = std::filesystem;

constexpr const char* kHost = "127.0.0.1";

/// The same words stand in the page itself (web/viewer/index.html), for those who serve it
/// otherwise; frame-ancestors is heeded in a header alone.
constexpr const char* kContentPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
    "connect-src 'self' blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

std::string mimeType(const std::string& name) {
  static const std::map<std::string, std::string> types = {
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".json", "application/json"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".jpg", "image/jpeg"},
      {".jpeg", "image/jpeg"},
      {".glb", "model/gltf-binary"},
      {".hdr", "image/vnd.radiance"},
      {".exr", "image/x-exr"}};
  const auto found = types.find(fs::path(name).extension().string());
  return found == types.end() ? "application/octet-stream" : found->second;
}

struct Piece {
  std::uint64_t first = 0;
  std::uint64_t count = 0;
};

/// What the header Range asks for of `size` bytes: nothing for what is to be answered with all of
/// them, as is everything but one range of bytes. A count of 0 is what no byte satisfies.
std::optional<Piece> askedRange(const httplib::Request& request, std::uint64_t size) {
  // There are no validators, so that no If-Range matches.
  if (request.method != "GET" || !request.has_header("Range") || request.has_header("If-Range"))
    return {};
  constexpr std::string_view kUnit = "bytes=";
  const std::string header = request.get_header_value("Range");
  const std::size_t dash = header.find('-');
  if (!header.starts_with(kUnit) || dash == header.npos) return {};
  const std::string_view from = std::string_view(header).substr(0, dash).substr(kUnit.size());
  const std::string_view to = std::string_view(header).substr(dash + 1);

  bool wellFormed = !(from.empty() && to.empty());
  const auto number = [&](std::string_view text, std::uint64_t ifEmpty) {
    if (text.empty()) return ifEmpty;
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end != text.data() + text.size()) wellFormed = false;
    return error == std::errc::result_out_of_range ? UINT64_MAX : value;
  };
  const std::uint64_t first = number(from, 0);
  const std::uint64_t last = number(to, UINT64_MAX);
  if (!wellFormed || (!from.empty() && last < first)) return {};
  if (from.empty()) {  // the last so many
    const std::uint64_t count = std::min(last, size);
    return Piece{size - count, count};
  }
  if (first >= size) return Piece{};
  return Piece{first, std::min(last, size - 1) - first + 1};
}

/// Sends a file piece by piece: an asset can be larger than what one would hold in memory.
void sendFile(const fs::path& path, const std::string& type, const httplib::Request& request,
              httplib::Response& response) {
  auto stream = std::make_shared<std::ifstream>(path, std::ios::binary);
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  if (!*stream || error) {
    response.status = 404;
    response.set_content(fmt::format("{} is no longer there\n", path.filename().string()),
                         "text/plain; charset=utf-8");
    return;
  }
  response.set_header("Accept-Ranges", "bytes");
  Piece piece{0, size};
  if (const auto asked = askedRange(request, size)) {
    piece = *asked;
    if (piece.count == 0) {
      response.status = 416;
      response.set_header("Content-Range", fmt::format("bytes */{}", size));
      return response.set_content("The file ends before that\n", "text/plain; charset=utf-8");
    }
    response.status = 206;
    response.set_header("Content-Range", fmt::format("bytes {}-{}/{}", piece.first,
                                                     piece.first + piece.count - 1, size));
  }
  if (piece.count == 0) return response.set_content("", type.c_str());
  response.set_content_provider(
      piece.count, type.c_str(),
      [stream, first = piece.first](std::size_t offset, std::size_t length,
                                    httplib::DataSink& sink) {
        std::vector<char> bytes(std::min<std::size_t>(length, 1 << 18));
        stream->seekg(std::streamoff(first + offset));
        stream->read(bytes.data(), std::streamsize(bytes.size()));
        if (stream->gcount() <= 0) return false;
        sink.write(bytes.data(), std::size_t(stream->gcount()));
        return true;
      });
}

void answer(const ServedFiles& files, const httplib::Request& request,
            httplib::Response& response) {
  const auto found = files.find(request.path == "/" ? "/index.html" : request.path);
  if (found == files.end()) {
    response.status = 404;
    return response.set_content("Not found\n", "text/plain; charset=utf-8");
  }
  const std::string type = mimeType(found->first);
  if (const auto* path = std::get_if<fs::path>(&found->second))
    return sendFile(*path, type, request, response);
  response.set_content(std::get<std::string>(found->second), type.c_str());
}

bool isOurHost(const std::string& host, int port) {
  for (const char* name : {kHost, "localhost"})
    if (host == fmt::format("{}:{}", name, port) || (port == 80 && host == name)) return true;
  return false;
}

void openInBrowser(std::string url) {
  const auto set = [](const char* name) {
    const char* value = std::getenv(name);
    return value && *value;
  };
  if (!set("DISPLAY") && !set("WAYLAND_DISPLAY")) return;
  std::string program = "xdg-open";
  char* arguments[] = {program.data(), url.data(), nullptr};
  // Signals that are ignored here would be ignored there.
  posix_spawnattr_t attributes;
  if (posix_spawnattr_init(&attributes) != 0) return;
  sigset_t usual;
  sigemptyset(&usual);
  sigaddset(&usual, SIGPIPE);
  posix_spawnattr_setsigdefault(&attributes, &usual);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  pid_t process;
  // A browser that does not open is no failure: the URL has been printed.
  posix_spawnp(&process, program.c_str(), nullptr, &attributes, arguments, environ);
  posix_spawnattr_destroy(&attributes);
}

int wakePipe[2] = {-1, -1};

extern "C" void onEnd(int) {
  const char byte = 0;
  if (write(wakePipe[1], &byte, 1) < 0) _exit(0);
}

/// Until SIGINT, SIGTERM or SIGHUP. A pipe, because whichever thread the signal reaches can do
/// little more than write to it.
Status waitForEnd() {
  if (pipe(wakePipe) != 0) return failed(fmt::format("cannot make a pipe: {}", strerror(errno)));
  struct sigaction action = {};
  action.sa_handler = onEnd;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
  char byte;
  while (read(wakePipe[0], &byte, 1) < 0 && errno == EINTR) {
  }
  return Status::ok();
}

}  // namespace

Result<fs::path> findViewerPage() {
  std::error_code error;
  const fs::path executable = fs::read_symlink("/proc/self/exe", error);
  if (error) return failed("cannot find out where this program lies: " + error.message());
  const fs::path page = (executable.parent_path() / "../share/lambent/viewer").lexically_normal();
  if (!fs::is_regular_file(page / "index.html", error))
    return badInput(fmt::format(
        "{}: the page is not there. It is built by npm (Node 20.19 or newer): install them and "
        "build again, in a build tree by cmake --build BUILD --target lambent_web",
        page.string()));
  return page;
}

Status serveViewer(const fs::path& asset, std::span<const std::string> environments,
                   const ReadingArguments& reading, const ServerOptions& options,
                   Console& console) {
  const Result<fs::path> page = findViewerPage();
  if (!page) return page.error();
  const Result<ServedFiles> files = filesToServe(*page, asset, environments, reading, console);
  if (!files) return files.error();

  ConnectionServer server;
  server.set_default_headers({{"Content-Security-Policy", kContentPolicy},
                              {"X-Content-Type-Options", "nosniff"},
                              {"Cross-Origin-Resource-Policy", "same-origin"},
                              {"Cross-Origin-Opener-Policy", "same-origin"},
                              {"Referrer-Policy", "no-referrer"},
                              {"Cache-Control", "no-store"}});
  // Without SO_REUSEPORT, which is the library's default and would let two servers share a port.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  server.set_tcp_nodelay(true);
  server.set_payload_max_length(0);  // nothing is taken in

  const int port = options.port;
  int bound = port;
  if (port == 0) bound = server.bind_to_any_port(kHost);
  if (bound <= 0 || (port != 0 && !server.bind_to_port(kHost, port)))
    return failed(
        fmt::format("cannot listen on {}:{}: {}. --port 0 takes one that is free", kHost, port,
                    errno == EADDRINUSE ? "something else does already" : strerror(errno)));

  server.lengthenBacklog();

  server.set_pre_routing_handler(
      [bound](const httplib::Request& request, httplib::Response& response) {
        if (isOurHost(request.get_header_value("Host"), bound))
          return httplib::Server::HandlerResponse::Unhandled;
        response.status = 403;
        response.set_content("This server answers to 127.0.0.1 and localhost alone\n",
                             "text/plain; charset=utf-8");
        return httplib::Server::HandlerResponse::Handled;
      });
  server.Get(".*", [&](const httplib::Request& request, httplib::Response& response) {
    answer(*files, request, response);
  });

  std::atomic<bool> over = false;
  std::thread listening([&] {
    server.listen_after_bind();
    over = true;
  });
  // stop() does nothing to a server that does not run yet.
  while (!server.is_running() && !over) std::this_thread::yield();
  const std::string url = fmt::format("http://{}:{}/", kHost, bound);
  // A server that nobody can find is of no use.
  Status ended = console.finish({{"url", url}}, url + '\n');
  if (ended) {
    console.note("viewer-served", url + " shows the asset; Ctrl-C ends it");
    if (options.openBrowser) openInBrowser(url);
    ended = waitForEnd();
  }
  server.stop();
  server.hangUp();
  listening.join();
  return ended;
}

}  // namespace lambent::tool
