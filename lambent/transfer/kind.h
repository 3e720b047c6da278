// What light does on its way to a receiver: the three kinds of transfer, and what is held for some
// of them.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>

namespace lambent::transfer {

/// Nothing hides it; surfaces hide it; surfaces hide it and send it on (sloan2002precomputed §4).
enum class Kind { Unshadowed, Shadowed, Interreflected };

inline constexpr std::array<Kind, 3> kKinds{Kind::Unshadowed, Kind::Shadowed, Kind::Interreflected};

/// A T for each kind that is held. Visited from the least kind to the most.
template <class T>
class ByKind {
 public:
  bool holds(Kind kind) const { return at(kind).has_value(); }
  bool empty() const { return !most(); }
  /// The kind that does most to the light, of those that are held.
  std::optional<Kind> most() const { return mostUpTo(Kind::Interreflected); }
  /// … and that does no more than `wanted`.
  std::optional<Kind> mostUpTo(Kind wanted) const {
    for (std::size_t k = std::size_t(wanted) + 1; k-- > 0;)
      if (held_[k]) return Kind(k);
    return std::nullopt;
  }

  T* find(Kind kind) { return at(kind) ? &*at(kind) : nullptr; }
  const T* find(Kind kind) const { return at(kind) ? &*at(kind) : nullptr; }
  T& set(Kind kind, T value) { return at(kind).emplace(std::move(value)); }
  void drop(Kind kind) { at(kind).reset(); }

  /// visit(kind, T&) for each that is held.
  template <class Visit>
  void each(Visit&& visit) {
    for (const Kind kind : kKinds)
      if (T* value = find(kind)) visit(kind, *value);
  }
  template <class Visit>
  void each(Visit&& visit) const {
    for (const Kind kind : kKinds)
      if (const T* value = find(kind)) visit(kind, *value);
  }

  /// f(T) of each that is held.
  template <class F>
  auto map(const F& f) const {
    ByKind<std::decay_t<std::invoke_result_t<const F&, const T&>>> result;
    each([&](Kind kind, const T& value) { result.set(kind, f(value)); });
    return result;
  }

 private:
  std::optional<T>& at(Kind kind) { return held_[std::size_t(kind)]; }
  const std::optional<T>& at(Kind kind) const { return held_[std::size_t(kind)]; }

  std::array<std::optional<T>, kKinds.size()> held_;
};

}  // namespace lambent::transfer
