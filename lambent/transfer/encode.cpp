// Every struct is taken apart whole before it is made anew: one with a member more does not compile
// until its map says what becomes of it.
#include "lambent/transfer/encode.h"

namespace lambent::transfer {

namespace {

// f(numbers, block): numbers of another storage; `block` of them belong together.

template <class N, class F>
auto mapped(const Vectors<N>& from, const F& f) {
  const auto& [bands, channels, numbers] = from;
  auto made = f(numbers, from.perVector());
  return Vectors<decltype(made)>{bands, channels, std::move(made)};
}

template <class N, class F>
auto mapped(const Matrices<N>& from, const F& f) {
  const auto& [outBands, inBands, channels, numbers] = from;
  auto made = f(numbers, from.perMatrix());
  return Matrices<decltype(made)>{outBands, inBands, channels, std::move(made)};
}

template <class N, class F>
auto mapped(const Diffuse<N>& from, const F& f) {
  const auto& [albedo, vectors] = from;
  auto made = mapped(vectors, f);
  return Diffuse<decltype(made.numbers)>{albedo, std::move(made)};
}

template <class N, class F>
auto mapped(const Glossy<N>& from, const F& f) {
  const auto& [lobe, matrices] = from;
  auto made = mapped(matrices, f);
  return Glossy<decltype(made.numbers)>{lobe, std::move(made)};
}

template <class M, class N, class F>
SurfaceResponse<M> mapped(const SurfaceResponse<N>& from, const F& f) {
  const auto& [diffuse, glossy] = from;
  SurfaceResponse<M> to;
  if (diffuse) to.diffuse = mapped(*diffuse, f);
  if (glossy) to.glossy = mapped(*glossy, f);
  return to;
}

template <class M, class N, class F>
Surface<M> mapped(const Surface<N>& from, const F& f) {
  const auto& [receivers, responses] = from;
  return {receivers, responses.map([&](const auto& response) { return mapped<M>(response, f); })};
}

template <class M, class N, class F>
BiScale<M> mapped(const BiScale<N>& from, const F& f) {
  const auto& [receivers, tangents, patch, bands, matrices] = from;
  return {receivers, tangents, patch, bands,
          matrices.map([&](const Matrices<N>& one) { return mapped(one, f); })};
}

template <class N, class F>
auto mapped(const Rtt<N>& from, const F& f) {
  const auto& [name, width, height, views, bands, size, depth, values, heights] = from;
  auto made = f(values, from.planeSize());
  return Rtt<decltype(made)>{name, width, height,          views,  bands,
                             size, depth, std::move(made), heights};
}

/// `ofSurfaces` maps the numbers of vectors and glossy matrices and of RTTs, `ofBiScale` those of
/// matrices into tangent frames.
template <class M, class N, class F, class G>
Field<M> mapped(const Field<N>& from, const F& ofSurfaces, const G& ofBiScale) {
  const auto& [kind, bands, directions, bounces, seed, passEnergy, meshes, rtts] = from;
  Field<M> to{kind, bands, directions, bounces, seed, passEnergy, {}, {}};
  to.meshes.reserve(meshes.size());
  const ForEachKind one{
      [](const NoTransfer& none) -> MeshTransfer<M> { return none; },
      [&](const Surface<N>& surface) -> MeshTransfer<M> { return mapped<M>(surface, ofSurfaces); },
      [&](const BiScale<N>& biScale) -> MeshTransfer<M> { return mapped<M>(biScale, ofBiScale); }};
  for (const MeshTransfer<N>& mesh : meshes) to.meshes.push_back(std::visit(one, mesh));
  for (const Rtt<N>& rtt : rtts) to.rtts.push_back(mapped(rtt, ofSurfaces));
  return to;
}

auto encoder(Encoding encoding) {
  return [encoding](const Floats& values, std::size_t block) {
    return encode(values, encoding, block);
  };
}

Floats decoded(const Numbers& numbers, std::size_t) {
  return decode(numbers);
}

}  // namespace

EncodedField encode(const SimulatedField& field, const Encodings& encodings) {
  return mapped<Numbers>(field, encoder(encodings.surfaces), encoder(encodings.biScale));
}

SimulatedField decode(const EncodedField& field) {
  return mapped<Floats>(field, decoded, decoded);
}

EncodedRtt encode(const Rtt<Floats>& rtt, Encoding encoding) {
  return mapped(rtt, encoder(encoding));
}

Rtt<Floats> decode(const EncodedRtt& rtt) {
  return mapped(rtt, decoded);
}

}  // namespace lambent::transfer
