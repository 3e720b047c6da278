#include "lambent/scene_io/obj_unread.h"

#include <algorithm>
#include <iterator>

namespace lambent::scene_io {
namespace {

constexpr std::string_view kPointsAndLines[] = {"l", "p"};
constexpr std::string_view kFreeForms[] = {"curv", "curv2", "surf", "bsp", "bzp", "cdc", "cdp"};
constexpr std::string_view kCalls[] = {"call", "csh"};
constexpr std::string_view kWithoutLook[] = {
    "g",    "mg",  "bevel", "c_interp", "d_interp", "lod",   "shadow_obj", "trace_obj",
    "vp",   "deg", "bmat",  "step",     "cstype",   "parm",  "trim",       "hole",
    "scrv", "sp",  "end",   "con",      "ctech",    "stech", "res"};

/// Different keys that are remembered; a file of noise has as many as it has lines.
constexpr std::size_t kMostKeys = 64;

template <class Keys>
bool isAmong(std::string_view key, const Keys& keys) {
  return std::find(std::begin(keys), std::end(keys), key) != std::end(keys);
}

}  // namespace

void UnreadStatements::add(std::string_view key, std::size_t line) {
  auto entry = counts_.find(key.substr(0, 40));
  if (entry == counts_.end()) {
    if (counts_.size() >= kMostKeys) key = "…";
    entry = counts_.try_emplace(std::string(key.substr(0, 40)), Count{0, line}).first;
  }
  ++entry->second.count;
}

void UnreadStatements::tell(Diagnosis& diagnosis) const {
  for (const auto& [key, count] : counts_) {
    const std::string place = "\"" + key + "\", line " + std::to_string(count.line);
    if (isAmong(key, kWithoutLook)) continue;
    if (isAmong(key, kPointsAndLines)) {
      diagnosis.lose(Severity::Note, "no-triangles", count.count,
                     "points and lines were left out: they have no surface", place);
    } else if (isAmong(key, kFreeForms)) {
      diagnosis.lose(Severity::Warning, "free-form-ignored", count.count,
                     "free-form curves and surfaces were left out and are not seen; export them "
                     "as polygons",
                     place);
    } else if (isAmong(key, kCalls)) {
      diagnosis.lose(Severity::Warning, "call-ignored", count.count,
                     "calls of other files were left out: what they hold is not seen; export all "
                     "as one file",
                     place);
    } else {
      diagnosis.lose(Severity::Warning, "statements-ignored", count.count,
                     "statements are of no kind that OBJ knows and were left out", place);
    }
  }
}

}  // namespace lambent::scene_io
