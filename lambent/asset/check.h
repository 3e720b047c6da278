// What must hold between a scene and its transfer, in memory as in a file: the one checker.
// Readers, writers and makers of pictures ask it; spec/refused.json says what it refuses.
#pragma once

#include <optional>
#include <string>

#include "lambent/asset/asset.h"
#include "lambent/asset/part_bytes.h"

namespace lambent::asset {

/// "mesh 3 ("teapot")": how messages name a mesh.
std::string meshLabel(const scene::Scene& scene, std::size_t mesh);

/// Shapes and finite numbers of one mesh's transfer against its scene mesh and the bands and RTTs
/// of the whole field. The message names the member and, for a number, its receiver, channel and
/// coefficient; the caller says which mesh.
std::optional<std::string> faultOf(const transfer::EncodedMesh& transfer, const scene::Mesh& mesh,
                                   const transfer::EncodedField& field);

/// The first thing wrong with an asset in memory; the message names the mesh.
std::optional<std::string> faultOf(const Asset& asset);

/// Bytes of every part in a file.
PartBytes bytesOf(const Asset& asset);
/// A .glb ends at 4 GiB: asked before anything of such a size is copied.
Status checkSize(const PartBytes& bytes);

/// Everything that read() would refuse, found before an hour's bake is written: ErrorKind::Failed.
Status checkForWriting(const Asset& asset);

}  // namespace lambent::asset
