#include "apps/viewer/file_question.h"

namespace lambent::viewer {

namespace {

using What = FileQuestion::What;

const FileKind kAssets{"Baked assets", {".glb", ".gltf"}};
const FileKind kLights{"Lights", {".exr", ".hdr", ".png", ".jpg", ".jpeg", ".webp", ".json"}};
const FileKind kViews{"Views", {".json"}};
const FileKind kPictures{"Pictures", {".png"}};
const FileKind kAll{"All files", {}};

}  // namespace

std::string titleOf(What what) {
  switch (what) {
    case What::OpenAsset:
      return "Open an asset";
    case What::OpenLight:
      return "Open a light";
    case What::SavePicture:
      return "Save the picture";
    case What::SaveView:
      return "Save the view";
  }
  return {};
}

std::vector<FileKind> kindsOf(What what) {
  switch (what) {
    case What::OpenAsset:
      return {kAssets, kLights, kViews, kAll};
    case What::OpenLight:
      return {kLights, kAll};
    case What::SavePicture:
      return {kPictures};
    case What::SaveView:
      return {kViews};
  }
  return {};
}

}  // namespace lambent::viewer
