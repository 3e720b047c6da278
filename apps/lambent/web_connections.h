// Connections that cannot hold one another up: cpp-httplib's pool gives a thread to whoever connects
// first, and waits for each piece of a request anew, so that eight clients which never finish theirs
// keep everybody else waiting for as long as they like.
#pragma once

#include <httplib.h>

#include <chrono>
#include <condition_variable>
#include <list>
#include <memory>
#include <mutex>
#include <thread>

namespace lambent::tool {

struct ConnectionLimits {
  /// With each a thread. One more takes the place of the one that has kept us waiting the longest,
  /// or, if all are being answered, of the one that takes the longest to hear its answer.
  std::size_t connections = 128;
  std::chrono::milliseconds room{5000};  ///< for one that was dismissed to end, before a refusal
  std::size_t requestsPerConnection = 1000;
  std::size_t requestBytes = 64 << 10;      ///< of one request: its line and its headers
  std::chrono::milliseconds idle{5000};     ///< from one request to the first byte of the next
  std::chrono::milliseconds request{5000};  ///< from its first byte to its last
  /// For each piece of an answer (up to 256 KiB). A page that compiles its shaders, sleeps in the
  /// background or stands in a debugger takes nothing in meanwhile, and a browser calls an answer
  /// that was cut off "failed to fetch". Who takes that long gives way to others, not to the clock.
  std::chrono::milliseconds writing = std::chrono::hours(1);
};

/// httplib::Server with a thread for each connection, within limits. Timeouts and a task queue that
/// are set by httplib's own functions are of no effect.
class ConnectionServer : public httplib::Server {
 public:
  explicit ConnectionServer(const ConnectionLimits& limits = {});
  ~ConnectionServer() override { hangUp(); }

  /// Lets a burst of connections wait to be accepted (httplib: five). After the server is bound.
  void lengthenBacklog();

  /// Ends the connections there are, in the middle of whatever they do, and takes in no others.
  /// Returns when their threads have ended, which does not depend on the clients.
  void hangUp();

 private:
  enum class Phase { Waiting, Answering, Dismissed, Ended };

  struct Connection {
    socket_t socket;  ///< closed once the phase is Ended
    Phase phase = Phase::Waiting;
    std::chrono::steady_clock::time_point since = std::chrono::steady_clock::now();
    std::thread thread;
  };

  /// Called by httplib for what it has accepted, on the thread that accepts.
  bool process_and_close_socket(socket_t socket) override;
  void serve(Connection& connection);
  void serveRequests(Connection& connection);
  void enter(Connection& connection, Phase phase);
  void joinEnded();
  void makeRoom();  ///< dismisses one

  ConnectionLimits limits_;
  std::mutex mutex_;  ///< over the rest
  bool hungUp_ = false;
  std::condition_variable ended_;  ///< a connection, or all of it
  std::list<std::unique_ptr<Connection>> connections_;
};

}  // namespace lambent::tool
