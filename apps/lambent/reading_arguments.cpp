#include "apps/lambent/reading_arguments.h"

#include <CLI/CLI.hpp>

#include "apps/lambent/arguments.h"

namespace lambent::tool {

void ReadingArguments::addLimitTo(CLI::App& app) {
  addParsed(app, "--memory-limit", memoryLimit, parseBytes,
            "The most that reading a file, with what it names, may take in memory, such as 500MiB "
            "or 16GiB (default: as much as a file of its size can need, at most 6 GiB)")
      ->option_text("SIZE")
      ->group("Reading");
}

void ReadingArguments::addTo(CLI::App& app) {
  app.add_flag("--allow-outside", allowOutside,
               "Read the buffers, pictures and material libraries that a file names wherever they "
               "lie, not only in its folder and below: for files that you trust")
      ->group("Reading");
  addLimitTo(app);
}

}  // namespace lambent::tool
