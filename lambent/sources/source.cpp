// The table of lights and the grammar of SOURCE. Syntax errors are BadUsage and come with an
// example; what is wrong with a file is BadInput and names it.
#include "lambent/sources/source.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "lambent/sources/kinds.h"

namespace lambent::sources {
using light::Environment;
using report::badUsage;

namespace {

using Takes = SourceKind::Takes;

constexpr SourceKind kKinds[] = {
    {"uniform", "uniform[:RADIANCE]", "the same from everywhere", Takes::Numbers, uniformLight},
    {"disc", "disc:AZIMUTH,ELEVATION,ANGULAR_DIAMETER[,RADIANCE]",
     "degrees; azimuth from +x towards +z, elevation from the horizon", Takes::Numbers, discLight},
    {"directional", "directional:AZIMUTH,ELEVATION[,IRRADIANCE]",
     "the same as a point infinitely far away", Takes::Numbers, directionalLight},
    {"sky", "sky:KEY=VALUE[,…]", "a sky with its Sun and ground, by the keys of 'lambent sky'",
     Takes::Keys, skyLight},
    {"latlong", "latlong:FILE", "an environment image of any size, latitude-longitude", Takes::File,
     latLongMap},
    {"cube", "cube:FILE", "its six faces in a cross, a row or a column", Takes::File, cubeMap},
    {"angular", "angular:FILE", "a light probe: the angular map", Takes::File, angularMap},
    {"ball", "ball:FILE", "a picture of a mirrored ball, cut to its rim", Takes::File, mirrorBall},
};

/// How files without a word are written; lightFromFile knows them.
struct Form {
  std::string_view syntax, help;
};
constexpr Form kFiles[] = {
    {"FILE.exr FILE.hdr FILE.png",
     "an environment image, latitude-longitude or as its header says"},
    {"FILE.exr:LAYER", "a layer or part of it that is not its picture"},
    {"LIGHT.json", "coefficients written by 'lambent light'"},
};

std::vector<Form> forms() {
  std::vector<Form> all(std::begin(kFiles), std::end(kFiles));
  for (const SourceKind& kind : kKinds) all.push_back({kind.syntax, kind.help});
  return all;
}

/// The same in a sentence.
std::string formsInWords() {
  const std::vector<Form> all = forms();
  std::string text = "A light is ";
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i > 0) text += i + 1 < all.size() ? ", " : " or ";
    text += all[i].syntax;
    text += fmt::format(" ({})", all[i].help);
  }
  return text + ", and several joined by '+' add up";
}

/// A term that begins with the word of its kind.
Term termOf(std::string_view text, const SourceKind& kind) {
  Term term{text, {}};
  if (text.size() > kind.word.size()) term.rest = text.substr(kind.word.size() + 1);
  return term;
}

Result<Light> makeTerm(std::string_view text, const SourceOptions& options) {
  if (const SourceKind* kind = kindOf(text)) return kind->make(termOf(text, *kind), options);
  if (std::optional<Result<Light>> light = lightFromFile(text, options)) return std::move(*light);
  return badUsage(fmt::format("light '{}': neither a kind of light nor a file that can be one. {}",
                              text, formsInWords()));
}

/// Where the term that starts at `at` ends. A '+' may belong to an exponent (1e+3) or to a file's
/// name: the longest run of parts that names a file is one term.
std::size_t endOfTerm(std::string_view text, std::size_t at) {
  const std::string_view rest = text.substr(at);
  const SourceKind* kind = kindOf(rest.substr(0, rest.find('+')));
  if (kind && kind->takes == Takes::Keys) return endOfKeys(text, at + kind->word.size());
  const bool numbers = kind && kind->takes == Takes::Numbers;
  // Where the file's name begins.
  const std::size_t name =
      std::min(at + (kind && !numbers ? kind->word.size() + 1 : 0), text.size());
  std::size_t firstPlus = text.size(), asFile = 0;
  for (std::size_t i = name; i <= text.size(); ++i) {
    if (i < text.size() && text[i] != '+') continue;
    const bool exponent = numbers && i < text.size() && i >= at + 2 &&
                          (text[i - 1] == 'e' || text[i - 1] == 'E') &&
                          (text[i - 2] == '.' || (text[i - 2] >= '0' && text[i - 2] <= '9'));
    if (exponent) continue;
    firstPlus = std::min(firstPlus, i);
    std::error_code ignored;
    if (std::filesystem::is_regular_file(pictureNameOf(text.substr(name, i - name)).path, ignored))
      asFile = i;
  }
  return asFile ? asFile : firstPlus;
}

}  // namespace

std::span<const SourceKind> sourceKinds() {
  return kKinds;
}

const SourceKind* kindOf(std::string_view term) {
  const std::string_view word = term.substr(0, term.find(':'));
  for (const SourceKind& kind : kKinds)
    if (word == kind.word) return &kind;
  return nullptr;
}

std::vector<std::string_view> sourceTerms(std::string_view text) {
  std::vector<std::string_view> terms;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = endOfTerm(text, at);
    terms.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return terms;
}

Result<Light> parseSource(std::string_view text, const SourceOptions& options) {
  if (text.empty()) return badUsage(fmt::format("the light is empty. {}", formsInWords()));
  std::optional<Light> sum;
  for (const std::string_view term : sourceTerms(text)) {
    if (term.empty())
      return badUsage(
          fmt::format("light '{}': nothing stands on one side of a '+'. {}", text, formsInWords()));
    Result<Light> light = makeTerm(term, options);
    if (!light) return light.error();
    if (!sum) {
      sum = std::move(*light);
      continue;
    }
    sum->value = sum->value + light->value;
    sum->findings.insert(sum->findings.end(), light->findings.begin(), light->findings.end());
  }
  return std::move(*sum);
}

Result<WithFindings<sky::ResolvedSky>> resolvedSky(std::string_view text) {
  std::optional<Term> sky;
  for (const std::string_view term : sourceTerms(text)) {
    const SourceKind* kind = kindOf(term);
    if (!kind || kind->make != skyLight) continue;
    if (sky)
      return badUsage(fmt::format("light '{}': '{}' and '{}' are two skies, but there is one air",
                                  text, sky->text, term));
    sky = termOf(term, *kind);
  }
  if (!sky)
    return badUsage(fmt::format(
        "light '{}' has no sky, and so no air: a term sky:KEY=VALUE,… says which", text));
  return resolvedTerm(*sky);
}

std::vector<std::filesystem::path> filesOf(std::string_view term) {
  const SourceKind* kind = kindOf(term);
  if (!kind) return {pictureNameOf(term).path};
  const std::string_view rest = term.substr(std::min(kind->word.size() + 1, term.size()));
  if (kind->takes == Takes::File) return {pictureNameOf(rest).path};
  if (kind->takes == Takes::Keys)
    if (const std::optional<std::string_view> file = atmosphereOf(rest))
      return {std::string(*file)};
  return {};
}

std::string sourceHelp() {
  constexpr std::size_t kColumn = 31;  // where what a form is begins
  std::string text = "SOURCE of light:\n";
  for (const Form& form : forms()) {
    const bool fits = 2 + form.syntax.size() < kColumn;
    text += fits ? fmt::format("  {:<{}}{}\n", form.syntax, kColumn - 2, form.help)
                 : fmt::format("  {}\n{:{}}{}\n", form.syntax, "", kColumn, form.help);
  }
  return text +
         "  A+B+…                        the sum of several. RADIANCE and IRRADIANCE are one "
         "number or\n"
         "                               R/G/B.\n";
}

}  // namespace lambent::sources
