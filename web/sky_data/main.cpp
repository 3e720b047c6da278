// lambent_sky_data PACKAGE [PART …]: what web/three-lambent knows of skies, made in its folder from the
// library's tables, and numbers to test it by. Parts: sky, air, skies (the fixture of skies), airs; all of
// them unless some are named.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "lambent/sky/make_sky.h"
#include "lambent/sky/table_cache.h"
#include "web/sky_data/compact_air.h"
#include "web/sky_data/compact_table.h"
#include "web/sky_data/fixture.h"

using namespace lambent;

namespace {

Result<page::TurbidSky> turbidSky(double turbidity) {
  const sky::Atmosphere atmosphere = sky::withTurbidity(*sky::preset("clear"), turbidity);
  std::optional<sky::SkyTable> table = sky::readTable(sky::cacheFolder(), atmosphere, 0);
  if (!table) {
    auto made = sky::SkyTable::make(atmosphere, 0);
    if (!made) return made.error();
    table = std::move(*made);
    if (const Status kept = sky::keepTable(sky::cacheFolder(), atmosphere, *table); !kept)
      fmt::print(stderr, "note: {}\n", kept.error().message);
  }
  return page::TurbidSky{atmosphere, std::move(*table)};
}

Result<std::string> sky() {
  std::vector<page::TurbidSky> skies;
  for (const double turbidity : page::turbidityNodes()) {
    auto made = turbidSky(turbidity);
    if (!made) return made.error();
    skies.push_back(std::move(*made));
  }
  return page::compactTable(skies, {});
}

Result<std::string> air() {
  const auto any = turbidSky(page::turbidityNodes().front());
  if (!any) return any.error();
  return page::compactAir(any->table.sunElevations(), {});
}

Status keep(const Result<std::string>& bytes, const std::string& path) {
  if (!bytes) return bytes.error();
  std::ofstream file(path, std::ios::binary);
  if (file.write(bytes->data(), std::streamsize(bytes->size())).flush()) return Status::ok();
  return report::badUsage(fmt::format("{}: cannot be written", path));
}

struct Part {
  const char *name, *path;
  Result<std::string> (*make)();
};
constexpr Part kParts[] = {{"sky", "data/sky.bin", sky},
                           {"air", "data/air.bin", air},
                           {"skies", "test/data/skies.json", page::skyFixture},
                           {"airs", "test/data/airs.json", page::airFixture}};

Status make(const std::string& package, const std::vector<std::string>& wanted) {
  for (const Part& part : kParts) {
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), part.name) == wanted.end())
      continue;
    if (const Status kept = keep(part.make(), fmt::format("{}/{}", package, part.path)); !kept)
      return kept;
  }
  return Status::ok();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: lambent_sky_data PACKAGE [sky|air|skies|airs …]\n");
    return 2;
  }
  const Status status = make(argv[1], {argv + 2, argv + argc});
  if (!status) fmt::print(stderr, "error: {}\n", status.error().message);
  return status ? 0 : 1;
}
