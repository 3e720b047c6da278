#include "apps/lambent/interrupt.h"

#include <unistd.h>

#include <csignal>

#include "lambent/file/atomic_file.h"
#include "lambent/file/temporary_folder.h"

namespace lambent::tool {

namespace {

extern "C" void onInterrupt(int signal) {
  file::AtomicFile::discardAll();
  file::TemporaryFolder::discardAll();
  if (isatty(STDERR_FILENO)) {
    const char newline = '\n';  // leave the progress bar's line to itself
    if (write(STDERR_FILENO, &newline, 1) < 0) _exit(128 + signal);
  }
  _exit(128 + signal);
}

}  // namespace

void installInterruptHandlers() {
  struct sigaction action = {};
  action.sa_handler = onInterrupt;
  sigfillset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace lambent::tool
