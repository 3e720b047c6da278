#include "apps/lambent/web_lights.h"

#include <string_view>

#include "apps/lambent/web_server.h"
#include "lambent/sources/source.h"

namespace lambent::tool {

std::string withPageLights(const std::string& source, const std::filesystem::path& view) {
  namespace fs = std::filesystem;
  const auto isThere = [](const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
  };
  std::string found;
  for (const std::string_view term : sources::sourceTerms(source)) {
    if (!found.empty()) found += '+';
    const fs::path name = sources::pictureNameOf(term).path;
    const bool sought = !sources::kindOf(term) && name.is_relative() && !isThere(name);
    const fs::path beside = view.parent_path() / name;
    if (sought && isThere(beside)) {
      found += (view.parent_path() / term).string();
      continue;
    }
    // A page that was not built has no lights either.
    const auto page = sought ? findViewerPage() : Result<fs::path>(fs::path());
    const bool ofPage = sought && page && isThere(*page / name);
    found += ofPage ? (*page / term).string() : std::string(term);
  }
  return found;
}

}  // namespace lambent::tool
