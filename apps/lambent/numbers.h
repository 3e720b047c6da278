// Every number of the command line: finite, in the range that its option names, or wrong usage.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "lambent/report/result.h"

namespace lambent::tool {

/// What an option takes, ends included.
struct NumberRange {
  double least = 0.0, most = 0.0;
  bool whole = false;  ///< no fractions

  bool holds(double value) const;
  /// "a whole number from 1 to 10"
  std::string inWords() const;
};

/// Seeds are told apart by 32 bits.
inline constexpr NumberRange kSeeds = {0.0, 4294967295.0};
inline constexpr NumberRange kReflectances = {0.0, 1.0};
inline constexpr NumberRange kLobeExponents = {0.0, 1e5};
/// EV, as in view states: 2 to the power of it stays far from what a float can hold.
inline constexpr NumberRange kExposures = {-60.0, 60.0};
/// Beyond, the square of a length is no float any more.
inline constexpr NumberRange kCoordinates = {-1e15, 1e15};

/// BadUsage that shows the text and what is allowed.
Result<double> parseNumber(std::string_view text, const NumberRange& range);

/// Bytes: a whole number, perhaps with B, K, KB, KiB, M, … in either case; each step is 1024.
Result<std::uint64_t> parseBytes(std::string_view text);

namespace numbers {
template <class T>
struct Held {
  using Type = T;
};
template <class T>
struct Held<std::optional<T>> {
  using Type = T;
};

std::string inShort(double value);
}  // namespace numbers

/// An option that takes one number, a whole one if `value` is. What `value` holds is its default; a std::optional has none.
template <class T>
CLI::Option* addNumber(CLI::App& app, const std::string& name, T& value, NumberRange range,
                       const std::string& description) {
  using Number = typename numbers::Held<T>::Type;
  static_assert(std::is_arithmetic_v<Number> && !std::is_same_v<Number, bool>);
  range.whole = std::is_integral_v<Number>;
  CLI::Option* option = app.add_option_function<std::string>(
      name,
      [&value, range, name](const std::string& text) {
        const Result<double> parsed = parseNumber(text, range);
        if (!parsed) throw CLI::ValidationError(name, parsed.error().message);
        value = static_cast<Number>(*parsed);
      },
      description);
  if constexpr (std::is_same_v<T, Number>) option->default_str(numbers::inShort(double(value)));
  return option;
}

/// The same of an option that may be given several times.
inline CLI::Option* addNumbers(CLI::App& app, const std::string& name, std::vector<float>& values,
                               NumberRange range, const std::string& description) {
  return app
      .add_option_function<std::vector<std::string>>(
          name,
          [&values, range, name](const std::vector<std::string>& texts) {
            values.clear();
            for (const std::string& text : texts) {
              const Result<double> parsed = parseNumber(text, range);
              if (!parsed) throw CLI::ValidationError(name, parsed.error().message);
              values.push_back(float(*parsed));
            }
          },
          description)
      ->allow_extra_args(false);
}

}  // namespace lambent::tool
