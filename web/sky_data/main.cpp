// lambent_sky_data SKY.bin [FIXTURE.json]: the skies of web/three-lambent, and numbers to test them by.
#include <cstdio>
#include <fstream>
#include <string>

#include <fmt/format.h>

#include "lambent/sky/make_sky.h"
#include "lambent/sky/table_cache.h"
#include "web/sky_data/compact_table.h"
#include "web/sky_data/fixture.h"

using namespace lambent;

namespace {

Result<std::vector<page::TurbidSky>> tables() {
  std::vector<page::TurbidSky> skies;
  for (const double turbidity : page::turbidityNodes()) {
    const sky::Atmosphere atmosphere = sky::withTurbidity(*sky::preset("clear"), turbidity);
    std::optional<sky::SkyTable> table = sky::readTable(sky::cacheFolder(), atmosphere, 0);
    if (!table) {
      auto made = sky::SkyTable::make(atmosphere, 0);
      if (!made) return made.error();
      table = std::move(*made);
      if (const Status kept = sky::keepTable(sky::cacheFolder(), atmosphere, *table); !kept)
        fmt::print(stderr, "note: {}\n", kept.error().message);
    }
    skies.push_back({atmosphere, std::move(*table)});
  }
  return skies;
}

Status keep(const Result<std::string>& bytes, const char* path) {
  if (!bytes) return bytes.error();
  std::ofstream file(path, std::ios::binary);
  if (file.write(bytes->data(), std::streamsize(bytes->size())).flush()) return Status::ok();
  return report::badUsage(fmt::format("{}: cannot be written", path));
}

Status make(int argc, char** argv) {
  const auto skies = tables();
  if (!skies) return skies.error();
  if (const Status kept = keep(page::compactTable(*skies, {}), argv[1]); !kept) return kept;
  return argc > 2 ? keep(page::skyFixture(), argv[2]) : Status::ok();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    fmt::print(stderr, "usage: lambent_sky_data SKY.bin [FIXTURE.json]\n");
    return 2;
  }
  const Status status = make(argc, argv);
  if (!status) fmt::print(stderr, "error: {}\n", status.error().message);
  return status ? 0 : 1;
}
