#include "apps/lambent/arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "apps/lambent/nearest_word.h"
#include "lambent/file/extension.h"

namespace lambent::tool {

namespace {

/// Numbers with commas between them.
Result<std::vector<double>> parseList(std::string_view text, const NumberRange& range) {
  std::vector<double> values;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const Result<double> value = parseNumber(text.substr(at, end - at), range);
    if (!value) return badUsage(fmt::format("'{}': {}", text, value.error().message));
    values.push_back(*value);
    at = end + 1;
  }
  return values;
}

Result<Vec3d> parseTriple(std::string_view text) {
  const auto values = parseList(text, kCoordinates);
  if (!values) return values.error();
  if (values->size() != 3)
    return badUsage(fmt::format("'{}' is not X,Y,Z: write three numbers, as in 0,1.5,4", text));
  return Vec3d((*values)[0], (*values)[1], (*values)[2]);
}

}  // namespace

Result<Size> parseSize(std::string_view text, int most) {
  const auto parseSide = [](std::string_view side) {
    int value = 0;
    const auto [rest, error] = std::from_chars(side.data(), side.data() + side.size(), value);
    return error == std::errc() && rest == side.data() + side.size() ? value : 0;
  };
  const std::size_t cross = text.find_first_of("xX");
  const int width = parseSide(text.substr(0, cross));
  const int height = cross == text.npos ? width : parseSide(text.substr(cross + 1));
  if (width < 1 || height < 1 || width > most || height > most)
    return badUsage(fmt::format(
        "'{}' is not a size: write WIDTHxHEIGHT, each from 1 to {}, as in 64x48", text, most));
  return Size{width, height};
}

Result<Vec3> parsePoint(std::string_view text) {
  const Result<Vec3d> point = parseTriple(text);
  if (!point) return point.error();
  return Vec3(point->cast<float>());
}

Result<Vec3> parseDirection(std::string_view text) {
  const Result<Vec3d> direction = parseTriple(text);
  if (!direction) return direction.error();
  const double length = direction->stableNorm();
  if (!(length > 0.0))
    return badUsage(fmt::format("'{}' is no direction: one of the numbers must not be 0", text));
  return Vec3((*direction / length).cast<float>());
}

Result<Rgb> parseReflectance(std::string_view text) {
  const auto values = parseList(text, kReflectances);
  if (!values)
    return badUsage(values.error().message + ". A surface cannot send out more light than it gets");
  if (values->size() == 1) return Rgb(Rgb::Constant(float(values->front())));
  if (values->size() != 3)
    return badUsage(fmt::format("'{}' is not a colour: write one number or R,G,B", text));
  return Rgb(float((*values)[0]), float((*values)[1]), float((*values)[2]));
}

std::string formatSize(const Size& size) {
  return fmt::format("{}x{}", size.width, size.height);
}

Error noSuch(std::string_view option, std::string_view given, std::string_view kind,
             const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 20;
  const std::vector<std::string> told(names.begin(), names.begin() + std::min(names.size(), kMost));
  std::string there = names.empty() ? "none" : fmt::format("{}", fmt::join(told, ", "));
  if (names.size() > kMost) there += fmt::format(" and {} more", names.size() - kMost);
  const std::string meant = nearestWord(given, names);
  return badUsage(fmt::format("{} {}: there is no such {}; there {} {}{}", option, given, kind,
                              names.size() < 2 ? "is" : "are", there,
                              meant.empty() ? "" : fmt::format(". Did you mean '{}'?", meant)));
}

std::vector<std::string> meshNames(const scene::Scene& scene) {
  std::vector<std::string> names;
  for (std::size_t m = 0; m < scene.meshes.size(); ++m)
    names.push_back(scene.meshes[m].name.empty() ? std::to_string(m) : scene.meshes[m].name);
  return names;
}

std::string extensionOf(const std::filesystem::path& path) {
  return file::extensionOf(path);
}

Status written(Status status) {
  if (status || status.error().kind != ErrorKind::Failed) return status;
  return badInput(status.error().message);
}

}  // namespace lambent::tool
