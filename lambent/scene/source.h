// What a file says beyond what light asks for, kept so that whoever writes the scene again says it
// too: whose it is, its tree of nodes, all of its materials.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "lambent/scene/scene.h"

namespace lambent::scene {

struct SourceNode {
  int number = -1;  ///< in the document
  int parent = -1;  ///< in Source::nodes, before this one
  Eigen::Matrix4d worldFromNode = Eigen::Matrix4d::Identity();  ///< as the scene stands here
};

struct SourcePicture {
  std::vector<std::uint8_t> encoded;  ///< PNG or JPEG; empty: not kept
  std::string mimeType;
};

/// A glTF file without its numbers. Other kinds of files say nothing that is not in the scene.
struct Source {
  std::string copyright, generator, title;  ///< of the asset, and the name of its scene
  std::string assetExtras;                  ///< JSON, or empty
  /// The document as JSON, as it was found but for lists of buffers, views and accessors.
  std::string document;
  std::vector<Material> materials;      ///< by number of the document, as they were read
  std::vector<SourceNode> nodes;        ///< of the scene that is shown, each after its parent
  std::vector<SourcePicture> pictures;  ///< by image of the document: those of which the scene has
                                        ///< no texture
};

}  // namespace lambent::scene
