#include "apps/lambent/standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string>

namespace lambent::tool {

void secureStandardStreams() {
  std::signal(SIGPIPE, SIG_IGN);
  // Opened for reading only, so that every write to it fails as it would to the closed stream. The
  // root is there even where no devices are. What is opened gets the lowest number that is free.
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0 && errno == EBADF && open("/dev/null", O_RDONLY) < 0)
      if (open("/", O_RDONLY | O_DIRECTORY) < 0) _exit(1);
}

void tell(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
  std::clearerr(stderr);
}

Status print(std::string_view text) {
  errno = 0;
  const bool taken = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (std::fflush(stdout) == 0 && taken) return Status::ok();
  const int reason = errno;
  std::clearerr(stdout);
  if (reason == EPIPE) return report::failed("");
  return report::failed(std::string("the results cannot be written to standard output: ") +
                        (reason ? std::strerror(reason) : "it takes no more") +
                        ". Files that were made are kept");
}

}  // namespace lambent::tool
