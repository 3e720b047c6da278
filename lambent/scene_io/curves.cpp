#include "lambent/scene_io/curves.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>

#include "lambent/file/atomic_file.h"
#include "lambent/file/extension.h"
#include "lambent/scene_io/text_cursor.h"
#include "lambent/scene_io/text_file.h"

namespace lambent::scene_io {
namespace {

std::string_view withoutBlanks(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// A finite number and nothing else.
std::optional<double> wholeNumber(std::string_view text) {
  const char* const end = text.data() + text.size();
  const auto parsed = parseNumber(text.data(), end);
  if (!parsed || parsed->end != end || !std::isfinite(parsed->value)) return {};
  return parsed->value;
}

Error badLine(const std::string& file, std::size_t line, const std::string& what) {
  return report::badInput(file + ", line " + std::to_string(line) + ": " + what);
}

Result<std::vector<Polyline>> curvesOfCsv(std::string_view text, const std::string& file) {
  std::vector<Polyline> curves;
  std::string_view name;
  TextCursor cursor(text);
  bool first = true;
  while (cursor.nextLine()) {
    const std::string_view line = withoutBlanks(cursor.rest());
    if (line.empty() || line.front() == '#') continue;
    std::array<std::string_view, 4> fields;
    std::size_t count = 0, at = 0;
    for (; at <= line.size(); ++count) {
      const std::size_t comma = std::min(line.find(',', at), line.size());
      if (count < fields.size()) fields[count] = withoutBlanks(line.substr(at, comma - at));
      at = comma + 1;
    }
    Vec3d point;
    bool numbers = count == fields.size();
    for (std::size_t k = 0; numbers && k < 3; ++k) {
      const auto number = wholeNumber(fields[k + 1]);
      numbers = number.has_value();
      if (numbers) point[Eigen::Index(k)] = *number;
    }
    const bool heading = first && !numbers;
    first = false;
    if (heading) continue;
    if (!numbers)
      return badLine(file, cursor.line(),
                     "should be curve,x,y,z: a name, and three numbers that are finite");
    if (curves.empty() || fields[0] != name) curves.emplace_back();
    name = fields[0];
    curves.back().push_back(point);
  }
  return curves;
}

/// "7", "7/2", "-1" → 0 …; nothing if there is no such vertex.
std::optional<std::size_t> vertexOf(std::string_view word, std::size_t count) {
  std::int64_t index = 0;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, index);
  if (error != std::errc() || (stop != end && *stop != '/')) return {};
  const std::int64_t at = index < 0 ? index + std::int64_t(count) : index - 1;
  if (at < 0 || at >= std::int64_t(count)) return {};
  return std::size_t(at);
}

Result<std::vector<Polyline>> curvesOfObj(std::string_view text, const std::string& file) {
  std::vector<Vec3d> vertices;
  std::vector<Polyline> curves;
  TextCursor cursor(text, TextCursor::Joining::Backslash);
  while (cursor.nextLine()) {
    const std::string_view kind = cursor.word();
    if (kind == "v") {
      Vec3d& vertex = vertices.emplace_back();
      for (Eigen::Index k = 0; k < 3; ++k) {
        const auto number = cursor.number();
        if (!number || !std::isfinite(*number))
          return badLine(file, cursor.line(), "a vertex takes three numbers that are finite");
        vertex[k] = *number;
      }
    } else if (kind == "l") {
      Polyline& curve = curves.emplace_back();
      for (std::string_view word = cursor.word(); !word.empty() && word.front() != '#';
           word = cursor.word()) {
        const auto vertex = vertexOf(word, vertices.size());
        if (!vertex)
          return badLine(file, cursor.line(),
                         "there is no vertex " + std::string(word.substr(0, 40)) + " among the " +
                             std::to_string(vertices.size()) + " before it");
        curve.push_back(vertices[*vertex]);
      }
    }
  }
  return curves;
}

}  // namespace

Result<std::vector<Polyline>> parseCurves(std::string_view text, CurveFormat format,
                                          const std::string& file) {
  auto curves = format == CurveFormat::Csv ? curvesOfCsv(text, file) : curvesOfObj(text, file);
  if (!curves) return curves;
  std::erase_if(*curves, [](const Polyline& curve) { return curve.size() < 2; });
  if (curves->empty())
    return report::badInput(
        file + " has no curve of two points or more: " +
        (format == CurveFormat::Csv ? "lines of curve,x,y,z" : "l elements of OBJ, as in l 1 2 3") +
        " would be some");
  return curves;
}

Result<std::vector<Polyline>> readCurves(const std::filesystem::path& path) {
  const std::string extension = file::extensionOf(path);
  if (extension != ".csv" && extension != ".obj")
    return report::badInput(path.string() + ": curves are read from .csv and .obj");
  const auto bytes = file::readWhole(path);
  if (!bytes) return bytes.error();
  const auto text = textOf(*bytes, path.string());
  if (!text) return text.error();
  return parseCurves(*text, extension == ".csv" ? CurveFormat::Csv : CurveFormat::Obj,
                     path.string());
}

}  // namespace lambent::scene_io
