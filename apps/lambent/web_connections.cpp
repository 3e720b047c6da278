#include "apps/lambent/web_connections.h"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <exception>
#include <functional>
#include <string>
#include <system_error>
#include <utility>

namespace lambent::tool {

namespace {

using Clock = std::chrono::steady_clock;

/// Waits until `events` can be done. False at the deadline, and where the connection is broken.
bool waitFor(socket_t socket, short events, Clock::time_point deadline) {
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) return false;
    pollfd wanted{socket, events, 0};
    const int ready = poll(&wanted, 1, int(left));
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) return false;
  }
}

/// One request and its answer. The deadline is that of the request as a whole: a client that sends
/// a byte now and then does not move it.
class ExchangeStream final : public httplib::Stream {
 public:
  ExchangeStream(socket_t socket, const ConnectionLimits& limits)
      : socket_(socket), limits_(limits) {}

  /// Waits for the first byte of a request, and gives it its time from there.
  bool awaitRequest() {
    if (begin_ == end_ && !waitFor(socket_, POLLIN, Clock::now() + limits_.idle)) return false;
    readBy_ = Clock::now() + limits_.request;
    bytesLeft_ = limits_.requestBytes;
    return true;
  }

  bool is_readable() const override { return begin_ < end_ || waitFor(socket_, POLLIN, readBy_); }
  bool is_writable() const override {
    return waitFor(socket_, POLLOUT, Clock::now() + limits_.writing);
  }

  ssize_t read(char* to, std::size_t size) override {
    if (begin_ == end_) {
      if (!waitFor(socket_, POLLIN, readBy_)) return -1;
      const ssize_t got = recv(socket_, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
      if (got <= 0) return got;
      begin_ = 0;
      end_ = std::size_t(got);
    }
    const std::size_t taken = std::min({size, end_ - begin_, bytesLeft_});
    if (taken == 0) return -1;
    std::memcpy(to, buffer_.data() + begin_, taken);
    begin_ += taken;
    bytesLeft_ -= taken;
    return ssize_t(taken);
  }

  ssize_t write(const char* from, std::size_t size) override {
    const auto deadline = Clock::now() + limits_.writing;
    std::size_t sent = 0;
    while (sent < size) {
      if (!waitFor(socket_, POLLOUT, deadline)) return -1;
      const ssize_t more = send(socket_, from + sent, size - sent, MSG_DONTWAIT | MSG_NOSIGNAL);
      if (more < 0 && errno != EAGAIN && errno != EINTR) return -1;
      if (more > 0) sent += std::size_t(more);
    }
    return ssize_t(size);
  }

  void get_remote_ip_and_port(std::string& ip, int& port) const override {
    address(&getpeername, ip, port);
  }
  void get_local_ip_and_port(std::string& ip, int& port) const override {
    address(&getsockname, ip, port);
  }
  socket_t socket() const override { return socket_; }

 private:
  void address(decltype(&getpeername) ask, std::string& ip, int& port) const {
    sockaddr_in found{};
    socklen_t size = sizeof found;
    char text[INET_ADDRSTRLEN];
    if (ask(socket_, reinterpret_cast<sockaddr*>(&found), &size) != 0 ||
        found.sin_family != AF_INET || !inet_ntop(AF_INET, &found.sin_addr, text, sizeof text))
      return;
    ip = text;
    port = ntohs(found.sin_port);
  }

  socket_t socket_;
  const ConnectionLimits& limits_;
  Clock::time_point readBy_;
  std::size_t bytesLeft_ = 0;
  std::array<char, 4096> buffer_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
};

/// httplib hands accepted sockets to a queue; here they go on to their own threads at once.
class AtOnce final : public httplib::TaskQueue {
 public:
  void enqueue(std::function<void()> task) override { task(); }
  void shutdown() override {}
};

}  // namespace

ConnectionServer::ConnectionServer(const ConnectionLimits& limits) : limits_(limits) {
  new_task_queue = [] { return new AtOnce; };
  // What httplib tells the client of it, in the header Keep-Alive.
  set_keep_alive_max_count(limits.requestsPerConnection);
  set_keep_alive_timeout(std::chrono::duration_cast<std::chrono::seconds>(limits.idle).count());
}

void ConnectionServer::lengthenBacklog() {
  ::listen(svr_sock_, int(limits_.connections));  // once more, which changes the number alone
}

bool ConnectionServer::process_and_close_socket(socket_t socket) {
  std::unique_lock lock(mutex_);
  joinEnded();
  if (connections_.size() >= limits_.connections) makeRoom();
  // Those that were dismissed count until they have ended: this bounds the number of threads. On a
  // busy machine a burst comes faster than they end, and who comes last is not turned away for it.
  const auto isRoom = [this] {
    joinEnded();
    return hungUp_ || connections_.size() < limits_.connections + limits_.connections / 2;
  };
  if (!ended_.wait_for(lock, limits_.room, isRoom) || hungUp_) {
    close(socket);
    return false;
  }
  connections_.push_back(std::make_unique<Connection>());
  Connection& connection = *connections_.back();
  connection.socket = socket;
  try {
    connection.thread = std::thread([this, &connection] { serve(connection); });
  } catch (const std::system_error&) {  // no more threads
    close(socket);
    connections_.pop_back();
    return false;
  }
  return true;
}

void ConnectionServer::serve(Connection& connection) {
  try {
    serveRequests(connection);
  } catch (const std::exception&) {
    // Out of memory, say: this client has to ask again.
  }
  enter(connection, Phase::Ended);
}

void ConnectionServer::serveRequests(Connection& connection) {
  ExchangeStream stream(connection.socket, limits_);
  bool more = true;
  for (std::size_t k = 1; more && k <= limits_.requestsPerConnection; ++k) {
    if (!stream.awaitRequest()) return;
    bool clientEnds = false;
    const bool last = k == limits_.requestsPerConnection;
    const auto whenRead = [&](httplib::Request& request) {
      enter(connection, Phase::Answering);
      request.ranges.clear();  // the handler reads the header itself
    };
    more = process_request(stream, last, clientEnds, whenRead) && !clientEnds;
    enter(connection, Phase::Waiting);
  }
}

void ConnectionServer::enter(Connection& connection, Phase phase) {
  const std::scoped_lock lock(mutex_);
  if (connection.phase == Phase::Dismissed && phase != Phase::Ended) return;
  connection.phase = phase;
  connection.since = Clock::now();
  if (phase != Phase::Ended) return;
  shutdown(connection.socket, SHUT_RDWR);
  close(connection.socket);
  ended_.notify_one();
}

void ConnectionServer::joinEnded() {
  connections_.remove_if([](const auto& connection) {
    if (connection->phase != Phase::Ended) return false;
    connection->thread.join();  // it has nothing left to do
    return true;
  });
}

void ConnectionServer::makeRoom() {
  Connection* first = nullptr;
  const auto order = [](const Connection& each) { return std::pair(each.phase, each.since); };
  for (const auto& connection : connections_)
    if (connection->phase < Phase::Dismissed && (!first || order(*connection) < order(*first)))
      first = connection.get();
  if (!first) return;
  first->phase = Phase::Dismissed;
  shutdown(first->socket, SHUT_RDWR);
}

void ConnectionServer::hangUp() {
  std::list<std::unique_ptr<Connection>> all;
  {
    const std::scoped_lock lock(mutex_);
    hungUp_ = true;
    ended_.notify_one();
    for (const auto& connection : connections_)
      if (connection->phase != Phase::Ended) shutdown(connection->socket, SHUT_RDWR);
    all.swap(connections_);
  }
  for (const auto& connection : all) connection->thread.join();
}

}  // namespace lambent::tool
