// lambent_page_assets FOLDER: the assets and environments that ship with the page.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "lambent/image/io.h"
#include "web/viewer/assets/scenes.h"

using namespace lambent;

namespace {

Status keep(const Result<asset::Asset>& asset, const std::filesystem::path& path) {
  if (!asset) return asset.error();
  return asset::write(*asset, path);
}

Status make(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (Status status : {image::write(page::studioLight(), folder / "studio.hdr"),
                        image::write(page::eveningSky(), folder / "evening.hdr"),
                        keep(page::stillLife(), folder / "still-life.glb"),
                        keep(page::wovenKnot(), folder / "woven-knot.glb")})
    if (!status) return status;
  return Status::ok();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: lambent_page_assets FOLDER\n");
    return 2;
  }
  const Status status = make(argv[1]);
  if (!status) fmt::print(stderr, "error: {}\n", status.error().message);
  return status ? 0 : 1;
}
