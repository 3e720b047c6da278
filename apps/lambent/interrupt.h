// Ctrl-C leaves no partial file.
#pragma once

namespace lambent::tool {

/// SIGINT, SIGTERM and SIGHUP remove every open temporary file and end the process with
/// 128 + signal. A file-size limit becomes an error of the write instead of a signal.
void installInterruptHandlers();

}  // namespace lambent::tool
