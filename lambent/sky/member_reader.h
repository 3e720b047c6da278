// Members of a JSON object that a person wrote, with a complaint that says which and what it may be.
#pragma once

#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lambent/report/result.h"

namespace lambent::sky {

using Words = std::initializer_list<std::string_view>;

/// What a number may be.
struct Bounds {
  double least, most;
  bool orZero = false;
};

/// As the value stands in the file, in ASCII, its first 40 characters.
std::string quotedJson(const nlohmann::json& value);

/// Levenshtein's distance: how many letters have to be put in, taken out or exchanged.
std::size_t editDistance(std::string_view a, std::string_view b);

/// "did you mean …?": the word that the given one is a part of (the shortest), or else comes nearest
/// to (of a path, its last part). What is like none: "there are …", all of them.
std::string hint(std::string_view given, const std::vector<std::string_view>& words);

/// Reads members into values that hold their defaults. The first thing that is wrong is kept, and
/// nothing is read after it. Paths are those of the messages ("air.density[3]"); a prefix ends with a
/// dot.
class MemberReader {
 public:
  using Json = nlohmann::json;
  static constexpr std::size_t kMostEntries = 10000;  ///< of a list

  /// `file` stands in messages for it, `document` for what is read ("an atmosphere").
  MemberReader(std::string file, std::string document)
      : file_(std::move(file)), document_(std::move(document)) {}

  bool sound() const { return complaint_.empty(); }
  Error error() const { return report::badInput(complaint_); }
  void complain(std::string_view path, std::string_view what);

  /// The member; nullptr if there is none or something is wrong already.
  const Json* find(const Json& parent, std::string_view key) const;
  /// `elsewhere`: keys of other places, which may be meant.
  void onlyKeys(const Json& parent, const std::string& prefix, Words known, Words elsewhere = {});

  /// `bounds` are those of the value times `scale`, which is what is kept.
  void number(const Json& value, const std::string& path, Bounds bounds, double& into,
              double scale = 1);
  /// Whether there is one.
  bool number(const Json& parent, const std::string& prefix, const std::string& key, Bounds bounds,
              double& into);
  /// At least one, at most kMostEntries.
  std::vector<double> list(const Json& value, const std::string& path, Bounds bounds,
                           double scale = 1);

  /// A length, or a list of them, stands at KEY_km or at KEY_m: the one that is there.
  struct Length {
    const Json* value;
    std::string path;
    double metres;  ///< of its unit
  };
  std::optional<Length> length(const Json& parent, const std::string& prefix,
                               const std::string& key);
  /// m.
  void length(const Json& parent, const std::string& key, Bounds bounds, double& into);

  /// Which of the words a text is.
  std::optional<std::size_t> word(const Json& value, std::string_view path, Words words);

 private:
  std::string file_, document_, complaint_;
};

}  // namespace lambent::sky
