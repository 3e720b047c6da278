#include "apps/lambent/web_manifest.h"

#include <fmt/format.h>

#include "apps/lambent/arguments.h"
#include "lambent/asset/asset.h"
#include "lambent/file/atomic_file.h"
#include "lambent/file/temporary_folder.h"
#include "lambent/image/io.h"
#include "lambent/image/maps.h"
#include "lambent/sources/source.h"

namespace lambent::tool {

namespace {

namespace fs = std::filesystem;

Result<std::string> readText(const fs::path& path) {
  const auto bytes = file::readWhole(path);
  if (!bytes) return bytes.error();
  return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
}

/// Everything in the folder, by the path it has there.
Status addPage(const fs::path& page, ServedFiles& files) {
  std::error_code error;
  for (fs::recursive_directory_iterator at(page, error), end; at != end; at.increment(error)) {
    if (at->is_regular_file(error))
      files["/" + at->path().lexically_relative(page).generic_string()] = at->path();
    if (error) break;
  }
  if (error) return badInput(fmt::format("{}: {}", page.string(), error.message()));
  return Status::ok();
}

/// What the page's readers would take for another light than the library does: other kinds of maps,
/// other primaries, layers.
bool needsConversion(const fs::path& path, const ReadingArguments& reading) {
  const std::string extension = extensionOf(path);
  if (extension == ".json") return false;
  const auto picture = image::readPicture(path, reading.forImage());
  return picture && (picture->converted || picture->image.width != 2 * picture->image.height);
}

/// A map of another kind than latitude and longitude, as an .exr in that.
Result<std::string> resampled(const std::string& term, int height,
                              const ReadingArguments& reading) {
  const auto parsed = sources::parseSource(term, reading.forSource({}));
  if (!parsed) return parsed.error();
  image::Image map(2 * height, height);
  const image::MapShape shape{image::MapKind::LatLong, map.width, map.height};
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x)
      map.at(x, y) =
          parsed->value.radiance(image::directionOf(shape, {x + 0.5, y + 0.5})->cast<float>());
  auto folder = file::TemporaryFolder::create();
  if (!folder) return folder.error();
  const fs::path path = folder->place("map.exr");
  if (const Status status = image::write(map, path); !status) return status.error();
  return readText(path);
}

/// Adds the files behind one SOURCE, and says under which names.
Result<Json> addEnvironment(const std::string& source, std::size_t number,
                            const ReadingArguments& reading, ServedFiles& files) {
  constexpr int kResampledHeight = 1024;
  Json names = Json::object();
  const auto terms = sources::sourceTerms(source);
  for (std::size_t k = 0; k < terms.size(); ++k) {
    const std::string term(terms[k]);
    const sources::SourceKind* kind = sources::kindOf(term);
    if (kind && kind->takes != sources::SourceKind::Takes::File) continue;
    const std::string stem = fmt::format("files/environment-{}-{}", number, k);
    const sources::PictureName picture = sources::pictureNameOf(term);
    std::string name = stem + extensionOf(picture.path);
    if (kind || !picture.layer.empty() || needsConversion(picture.path, reading)) {
      name = stem + ".exr";
      const auto bytes = resampled(term, kResampledHeight, reading);
      if (!bytes) return bytes.error();
      files["/" + name] = *bytes;
    } else {
      files["/" + name] = fs::absolute(term);
    }
    names[term] = name;
  }
  const bool isFile = terms.size() == 1 && !names.empty();
  return Json{{"name", isFile ? fs::path(source).filename().string() : source},
              {"source", source},
              {"files", names}};
}

void putFirst(Json& list, Json entries) {
  for (Json& own : list) entries.push_back(std::move(own));
  list = std::move(entries);
}

}  // namespace

Result<ServedFiles> filesToServe(const fs::path& page, const fs::path& asset,
                                 std::span<const std::string> environments,
                                 const ReadingArguments& reading, Console& console) {
  ServedFiles files;
  if (const Status status = addPage(page, files); !status) return status.error();
  const auto own = readText(page / "manifest.json");
  if (!own) return own.error();
  Json manifest = Json::parse(*own, nullptr, false);
  if (manifest.is_discarded() || !manifest.is_object() || !manifest["assets"].is_array() ||
      !manifest["environments"].is_array())
    return badInput(fmt::format("{}: not the page's list of files. Build the page again",
                                (page / "manifest.json").string()));

  if (!asset.empty()) {
    const auto baked = asset::isAsset(asset);
    if (!baked) return baked.error();
    if (!*baked)
      console.note(
          "not-baked",
          fmt::format("{}: it has not been baked: the page shows it as it is, under a light "
                      "without shadows. To relight it: lambent bake {} -o baked.glb",
                      asset.string(), asset.string()));
    files["/files/asset.glb"] = fs::absolute(asset);
    putFirst(manifest["assets"],
             Json::array({{{"name", asset.filename().string()}, {"file", "files/asset.glb"}}}));
  }
  Json given = Json::array();
  for (std::size_t k = 0; k < environments.size(); ++k) {
    const auto light = console.stage("light", [&] {
      return sources::parseSource(environments[k],
                                  {.notFinite = sources::SourceOptions::NotFinite::Repair,
                                   .memoryLimit = reading.memoryLimit,
                                   .progress = console.progress()});
    });
    if (!light) return light.error();
    if (Status whole = console.accept(light->findings); !whole) return whole.error();
    auto entry = addEnvironment(environments[k], k, reading, files);
    if (!entry) return entry.error();
    given.push_back(std::move(*entry));
  }
  putFirst(manifest["environments"], std::move(given));
  files["/manifest.json"] =
      manifest.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  return files;
}

}  // namespace lambent::tool
