// The extensions of glTF: which are read, and what it changes that another is not.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "lambent/scene_io/diagnosis.h"

namespace lambent::scene_io {

/// Whether a file may require it: it is read, or what is left without it is not of a wrong shape.
bool mayBeRequired(std::string_view name);

/// Whether it stands in what is written as it was found: what it says is right there too.
bool isCarried(std::string_view name);

/// How often each extension is used: any member called "extensions" but for those of "extras".
std::map<std::string, std::uint64_t> extensionsIn(const nlohmann::json& document);

/// What to do about a file that requires another one.
std::string remedyFor(std::string_view extension);

/// One finding for each extension that the document declares, or uses anywhere, and that is not
/// read: how often it is used, what it changes, and the remedy. Its code is "extension-" and the
/// name.
void noteExtensions(const nlohmann::json& document, Diagnosis& diagnosis);

}  // namespace lambent::scene_io
