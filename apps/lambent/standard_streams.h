// Standard error and standard output, which may be full, or closed, or a pipe that nobody reads: a
// command's work is worth more than what is said about it.
#pragma once

#include <string_view>

#include "lambent/report/result.h"

namespace lambent::tool {

/// Called before any file is opened: a stream that was closed must not become a file of ours.
/// A write to a pipe that nobody reads is from then on an error, and no signal.
void secureStandardStreams();

/// To standard error. What cannot be said is lost, and nothing else is.
void tell(std::string_view text);

/// To standard output, at once. Failed if it does not arrive: the results are what was asked for.
/// Without a message where a pipe has been closed by who read it ('| head -1'): nobody misses it.
Status print(std::string_view text);

}  // namespace lambent::tool
