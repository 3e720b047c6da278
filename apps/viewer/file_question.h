// What a person is asked for: the name of a file to open or to write.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "apps/viewer/gl_window.h"

namespace lambent::viewer {

/// A kind of files in a dialog: "Baked assets", {".glb", ".gltf"}. No extension: all files.
struct FileKind {
  std::string name;
  std::vector<std::string> extensions;
};

struct FileQuestion {
  enum class What { OpenAsset, OpenLight, SavePicture, SaveView } what = What::OpenAsset;
  std::filesystem::path folder;  ///< where the dialog begins; empty: its own choice
  std::string name;              ///< of what is to be written, as it is proposed
  PixelSize picture;             ///< of SavePicture: its size

  bool saves() const { return what == What::SavePicture || what == What::SaveView; }
};

/// "Open an asset", the title of a dialog.
std::string titleOf(FileQuestion::What what);
/// The first is the one that is meant.
std::vector<FileKind> kindsOf(FileQuestion::What what);

/// How the desktop answered.
struct FileAnswer {
  enum class How {
    Chosen,
    Cancelled,
    NoDialog,  ///< there is none to ask: `text` says why
    Failed     ///< it was asked, and what it said is of no use: `text` says why
  } how = How::Cancelled;
  std::filesystem::path path;  ///< of Chosen
  std::string text;
};

}  // namespace lambent::viewer
