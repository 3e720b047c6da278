#include "lambent/scene_io/file_finder.h"

#include <algorithm>
#include <cctype>

#include "lambent/scene_io/text_file.h"

namespace lambent::scene_io {
namespace {

namespace fs = std::filesystem;

/// Entries of one folder that are looked at for other capitals.
constexpr std::size_t kMostEntries = 100000;

/// Bytes of a name that is looked for under other spellings.
constexpr std::size_t kLongestName = 1024;

std::string lowered(std::string text) {
  for (char& c : text) c = char(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '"' || c == '\''; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

bool isFile(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

/// "C:\pack\wood.png" is no relative name here, either.
bool isOfAnotherMachine(const std::string& name) {
  return name.starts_with('/') ||
         (name.size() > 1 && name[1] == ':' && std::isalpha(static_cast<unsigned char>(name[0])));
}

}  // namespace

std::string FileFinder::entryOf(const fs::path& folder, const std::string& name) {
  const auto [entry, isNew] = entries_.try_emplace(folder);
  if (isNew) {
    std::error_code error;
    const fs::path shown = folder.empty() ? fs::path(".") : folder;
    fs::directory_iterator it(shown, error);
    for (std::size_t i = 0; !error && it != fs::directory_iterator() && i < kMostEntries; ++i) {
      const std::string own = it->path().filename().string();
      // Of two that differ in capitals alone it is the first in the alphabet, on every machine.
      const auto [known, first] = entry->second.try_emplace(lowered(own), own);
      if (!first) known->second = std::min(known->second, own);
      it.increment(error);
    }
  }
  const auto known = entry->second.find(lowered(name));
  return known == entry->second.end() ? std::string() : known->second;
}

bool FileFinder::mayLookInto(const fs::path& folder) {
  const auto [entry, isNew] = inBounds_.try_emplace(folder, false);
  if (isNew) entry->second = files_.mayRead(folder.empty() ? fs::path(".") : folder);
  return entry->second;
}

fs::path FileFinder::withOtherCapitals(const fs::path& folder, const fs::path& name) {
  fs::path at = folder;
  for (const fs::path& part : name) {
    if (part == "." || part == "..") {
      at /= part;
      continue;
    }
    if (!mayLookInto(at)) return {};
    const std::string own = entryOf(at, part.string());
    if (own.empty()) return {};
    at /= own;
  }
  return at;
}

FileFinder::Found FileFinder::find(const fs::path& folder, std::string_view name,
                                   const fs::path& beside) {
  const std::string_view whole = trimmed(name);
  if (const fs::path exact = folder / whole; isFile(exact) && files_.mayRead(exact)) {
    return {exact, true, false};
  }
  std::string clean(whole);
  std::replace(clean.begin(), clean.end(), '\\', '/');
  if (clean.empty() || clean.size() > kLongestName) return {folder / clean, false, false};
  if (const std::string_view bare = withoutComment(clean); bare.size() < clean.size()) {
    const Found found = find(folder, bare, beside);
    if (found.exists) return found;
  }
  const fs::path said = folder / clean;
  if (isFile(said) && files_.mayRead(said)) return {said, true, false};
  if (!isOfAnotherMachine(clean)) {
    const fs::path other = withOtherCapitals(folder, clean);
    if (isFile(other)) return {other, true, false};
  }
  for (std::size_t cut = clean.find_first_of("/:"); cut != std::string::npos;
       cut = clean.find_first_of("/:", cut + 1)) {
    const fs::path last = clean.substr(cut + 1);
    if (last.empty() || last.is_absolute() ||
        std::find(last.begin(), last.end(), "..") != last.end()) {
      continue;
    }
    for (const fs::path& place : {folder, beside}) {
      const fs::path found = withOtherCapitals(place, last);
      if (!found.empty() && isFile(found) && files_.mayRead(found)) return {found, true, true};
    }
  }
  if (beside != folder) {
    const fs::path found = withOtherCapitals(beside, clean);
    if (!isOfAnotherMachine(clean) && isFile(found)) return {found, true, true};
  }
  // It may be there and out of bounds: the reader says so.
  return {said, isFile(said), false};
}

}  // namespace lambent::scene_io
