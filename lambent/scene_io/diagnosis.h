// What every reader does with a mesh before it leaves the room, and the findings it gathers.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>

#include "lambent/report/finding.h"
#include "lambent/report/result.h"
#include "lambent/scene/scene.h"

namespace lambent::scene_io {

/// Findings of one file: the same thing in several places is one finding with a count and its first
/// place.
class Diagnosis {
 public:
  /// `what` completes "<count> …" ("degenerate triangles were kept out"), or with a count of 0
  /// stands alone, for what concerns the whole file; `place` is the first place, and may be empty.
  void add(Severity severity, const std::string& code, std::uint64_t count, const std::string& what,
           const std::string& place = {});
  /// The same for what the file says and the scene does not have. `what` says what was left out,
  /// what that changes, and the remedy.
  void lose(Severity severity, const std::string& code, std::uint64_t count,
            const std::string& what, const std::string& place = {});
  Findings findings() const;

 private:
  struct Entry {
    Severity severity;
    std::uint64_t count;
    std::string what, place;
    bool loss = false;
  };
  std::map<std::string, Entry> entries_;
};

/// Which of winding and normals is believed where all of a mesh's normals contradict its winding.
enum class Front {
  Winding,  ///< glTF: the specification defines the front by the winding
  Normals,  ///< OBJ, PLY: writers care about normals and often not about winding
};

struct FinishOptions {
  Front front = Front::Winding;
  /// Keep unused vertices and degenerate triangles (see GltfLoadOptions::keepAllVertices).
  bool keepAllVertices = false;
  /// Radians: made normals are smooth across edges that bend by less, and vertices there are split.
  /// Nothing: smooth everywhere, and no vertex is split.
  std::optional<float> crease;
  /// Without `crease`, one per vertex: vertices of the same group share a made normal. Empty: each its own.
  std::span<const std::uint32_t> groups;
};

/// Where normals became others than tangents were made for: viewers make their own.
void dropTangents(scene::Mesh& mesh, const std::string& place, Diagnosis& diagnosis);

/// Checks and repairs a mesh whose indices are already known to be in range:
///  - degenerate triangles (a height below a millionth of the longest side) are kept out;
///  - unused vertices are dropped;
///  - a position that is not finite is an error that names the vertex;
///  - triangles that are wound against their own three normals and against their neighbours are
///    reversed; where there are no normals, those that are wound against their neighbours
///    (scene/winding.h);
///  - normals are made where there are none (angle-weighted), and where one is zero or not finite;
///    all are unit afterwards;
///  - a normal opposite to the winding of the triangles around it is turned to their front. If that
///    is so for (nearly) all of a closed mesh whose volume is negative, or of any mesh under
///    Front::Normals, the winding is turned instead;
///  - a closed mesh that is inside out is reported, and left: it may be a room;
///  - UVs and colours that are not finite become 0 and 1; colours are clamped to [0, 1].
/// `place` names the mesh in messages. Sets `kept` to whether vertices and triangles are all still
/// there in their sequence. A mesh without triangles is left empty; the caller drops it.
Status finishMesh(scene::Mesh& mesh, const FinishOptions& options, const std::string& file,
                  const std::string& place, Diagnosis& diagnosis, bool* kept = nullptr);

}  // namespace lambent::scene_io
