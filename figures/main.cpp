// Makes the pictures and tables of docs/reproduction.md.
//
// usage: lambent_figures INPUTS OUTPUT [--quick] [--suns 60,94,…] [--patches weave,…]
//                        [--forms bunny,…] [NAME …]
//   NAME: figure3 figure9 figure10 figure11 figure12 table1 diffuse-accuracy glossy-accuracy
//         biscale-truth biscale-resolution biscale-figure1 biscale-figure3 biscale-figure4
//         biscale-figure5 biscale-figure6 biscale-vase biscale-filter biscale-encodings
//         biscale-rtt-methods capture-projection capture-figure5 sky-meridian sky-accuracy
//         sky-optical-lengths sky-chromaticity sky-compact sky-preetham sky-aerial sky-24-hours
//         sun-shadow refinement surfaces synthesis
//   --suns: the Sun's zenith angles, degrees, of sky-accuracy; an exact sky takes minutes.
//   --patches, --forms: of synthesis, those alone; a patch on a form takes a minute.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "figures/accuracy.h"
#include "figures/biscale.h"
#include "figures/capture.h"
#include "figures/pictures.h"
#include "figures/refinement.h"
#include "figures/sky.h"
#include "figures/sun_shadow.h"
#include "figures/surfaces.h"
#include "figures/synthesis.h"

namespace {

/// What stands between commas.
std::vector<std::string> wordsOf(const std::string& list) {
  std::vector<std::string> words;
  std::istringstream stream(list);
  for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
  return words;
}

/// "60,94": what is no number counts 0.
std::vector<double> numbersOf(const std::string& list) {
  std::vector<double> numbers;
  for (const std::string& word : wordsOf(list))
    numbers.push_back(std::strtod(word.c_str(), nullptr));
  return numbers;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace lambent::figures;
  const std::vector<std::pair<std::string, std::function<void(const Studio&)>>> all = {
      {"figure3", figure3},
      {"figure9", figure9},
      {"figure10", figure10},
      {"figure11", figure11},
      {"figure12", figure12},
      {"table1", table1},
      {"diffuse-accuracy", diffuseAccuracy},
      {"glossy-accuracy", glossyAccuracy},
      {"biscale-truth", biscaleTruth},
      {"biscale-resolution", biscaleResolution},
      {"biscale-figure1", biscaleFigure1},
      {"biscale-figure3", biscaleFigure3},
      {"biscale-figure4", biscaleFigure4},
      {"biscale-figure5", biscaleFigure5},
      {"biscale-figure6", biscaleFigure6},
      {"biscale-vase", biscaleVase},
      {"biscale-filter", biscaleFilter},
      {"biscale-encodings", biscaleEncodings},
      {"biscale-rtt-methods", biscaleRttMethods},
      {"capture-projection", captureProjection},
      {"capture-figure5", captureFigure5},
      {"sky-meridian", skyMeridian},
      {"sky-accuracy", skyAccuracy},
      {"sky-optical-lengths", skyOpticalLengths},
      {"sky-chromaticity", skyChromaticity},
      {"sky-compact", skyCompact},
      {"sky-preetham", skyPreetham},
      {"sky-aerial", skyAerial},
      {"sky-24-hours", sky24Hours},
      {"sun-shadow", sunShadow},
      {"refinement", refinement},
      {"surfaces", surfaces},
      {"synthesis", synthesisSheets}};
  Studio studio;
  std::vector<std::string> words(argv + 1, argv + argc), wanted;
  std::vector<std::string> places;
  std::string option;  // that a list follows
  for (const std::string& word : words) {
    if (word == "--quick")
      studio.quick = true;
    else if (option == "--suns")
      studio.suns = numbersOf(word), option.clear();
    else if (option == "--patches")
      studio.patches = wordsOf(word), option.clear();
    else if (option == "--forms")
      studio.forms = wordsOf(word), option.clear();
    else if (word == "--suns" || word == "--patches" || word == "--forms")
      option = word;
    else if (places.size() < 2)
      places.push_back(word);
    else
      wanted.push_back(word);
  }
  if (places.size() < 2) {
    fmt::print(stderr,
               "usage: lambent_figures INPUTS OUTPUT [--quick] [--suns LIST] [--patches LIST] "
               "[--forms LIST] [NAME ...]\n");
    return 2;
  }
  studio.inputs = places[0], studio.output = places[1];
  std::filesystem::create_directories(studio.output);
  for (const std::string& name : wanted) {
    const bool known = std::any_of(all.begin(), all.end(),
                                   [&](const auto& figure) { return figure.first == name; });
    if (known) continue;
    fmt::print(stderr, "figures: there is no '{}'\n", name);
    return 2;
  }
  for (const auto& [name, make] : all) {
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), name) == wanted.end()) continue;
    const auto start = std::chrono::steady_clock::now();
    make(studio);
    fmt::print("{}: {:.1f} s\n\n", name,
               std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    std::fflush(stdout);
  }
  return 0;
}
