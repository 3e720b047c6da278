#include "apps/lambent/arguments.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "lambent/file/atomic_file.h"
#include "lambent/file/extension.h"

namespace lambent::tool {

namespace {

Result<std::vector<double>> parseList(std::string_view text) {
  std::vector<double> values;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const Result<double> value = parseNumber(text.substr(at, end - at));
    if (!value) return value.error();
    values.push_back(*value);
    at = end + 1;
  }
  return values;
}

}  // namespace

Result<double> parseNumber(std::string_view text) {
  double value = 0.0;
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || rest != end || !std::isfinite(value))
    return badUsage(fmt::format("'{}' is not a number", text));
  return value;
}

Result<Size> parseSize(std::string_view text) {
  const auto parseSide = [](std::string_view side) {
    int value = 0;
    const auto [rest, error] = std::from_chars(side.data(), side.data() + side.size(), value);
    return error == std::errc() && rest == side.data() + side.size() ? value : 0;
  };
  const std::size_t cross = text.find_first_of("xX");
  const int width = parseSide(text.substr(0, cross));
  const int height = cross == text.npos ? width : parseSide(text.substr(cross + 1));
  if (width < 1 || height < 1 || width > 32768 || height > 32768)
    return badUsage(fmt::format(
        "'{}' is not a size: write WIDTHxHEIGHT, each from 1 to 32768, as in 1024x768", text));
  return Size{width, height};
}

Result<Vec3> parseTriple(std::string_view text) {
  const auto values = parseList(text);
  if (!values) return values.error();
  if (values->size() != 3)
    return badUsage(fmt::format("'{}' is not X,Y,Z: write three numbers, as in 0,1.5,4", text));
  return Vec3(float((*values)[0]), float((*values)[1]), float((*values)[2]));
}

Result<Rgb> parseRgb(std::string_view text) {
  const auto values = parseList(text);
  if (!values) return values.error();
  if (values->size() == 1) return Rgb(Rgb::Constant(float(values->front())));
  if (values->size() != 3)
    return badUsage(fmt::format("'{}' is not a colour: write one number or R,G,B", text));
  return Rgb(float((*values)[0]), float((*values)[1]), float((*values)[2]));
}

std::string formatSize(const Size& size) {
  return fmt::format("{}x{}", size.width, size.height);
}

std::string extensionOf(const std::filesystem::path& path) {
  return file::extensionOf(path);
}

Status checkOutput(const std::filesystem::path& path,
                   std::initializer_list<std::string_view> extensions,
                   const std::filesystem::path& input) {
  const std::string extension = extensionOf(path);
  if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end())
    return badUsage(
        fmt::format("the output {} must end in {}", path.string(), fmt::join(extensions, " or ")));
  std::error_code ignored;
  if (std::filesystem::equivalent(path, input, ignored))
    return badUsage(
        fmt::format("the output {} would replace the input: give it another name", path.string()));
  return written(file::checkWritable(path));
}

Status written(Status status) {
  if (status || status.error().kind != ErrorKind::Failed) return status;
  return badInput(status.error().message);
}

}  // namespace lambent::tool
