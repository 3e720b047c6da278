// `lambent view --web`: the page that shows assets, served on this machine to this machine alone.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "apps/lambent/console.h"
#include "apps/lambent/reading_arguments.h"
#include "lambent/report/result.h"

namespace lambent::tool {

/// Where the page's files are: share/lambent/viewer beside the folder of the executable, in the
/// build tree as in an installation. BadInput with the remedy if they are not there.
Result<std::filesystem::path> findViewerPage();

struct ServerOptions {
  int port = 0;             ///< 0 takes a free one. One that is taken is Failed
  bool openBrowser = true;  ///< by xdg-open, where there is a display
};

/// Serves the page on 127.0.0.1 until Ctrl-C, which is success. Prints the URL on stdout.
///  - `asset`: what the page opens, or empty for the page's own.
///  - `environments`: SOURCEs as sources::parseSource takes them, what the page can switch between;
///    the first is shown. Their files are served under fixed names, so that nothing else of the
///    disk can be asked for. All are read once before, so that what is wrong with one is said here.
/// Failed if the URL cannot be printed. Ends the handlers of apps/lambent/interrupt.h for SIGINT and SIGTERM: there is no partial file.
Status serveViewer(const std::filesystem::path& asset, std::span<const std::string> environments,
                   const ReadingArguments& reading, const ServerOptions& options, Console& console);

}  // namespace lambent::tool
