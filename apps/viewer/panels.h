// The panel beside the picture, and what lies over it: messages, help, the question for a file.
#pragma once

#include <string>

#include "apps/viewer/frame_times.h"
#include "apps/viewer/layout.h"
#include "apps/viewer/session.h"
#include "apps/viewer/sky_map.h"

namespace lambent::viewer {

class Panels {
 public:
  void draw(Session& session, const FrameTimes& times, const Layout& layout);

 private:
  void drawFiles(Session& session, const PixelSize& picture);
  void drawLight(Session& session);
  void drawAsset(Session& session);
  void drawPicture(Session& session);
  void drawTimes(const Session& session, const FrameTimes& times);

  SkyMap sky_;
  std::string file_;  ///< what is typed into the question for a file
  bool asking_ = false, complaining_ = false;

  void drawQuestion(Session& session);
  void drawProblem(Session& session, float scale);
};

// What needs no memory of its own.
void drawDiscs(Session& session, SkyMap& sky);
void drawSky(Session& session);
void drawTransfer(Session& session);
void drawSurroundings(Session& session);
void drawHelp(Session& session, const Layout& layout);
void drawRemarks(const Session& session, const Layout& layout);
/// Why the window asks for a file itself, and how it is answered.
std::string wordsOf(const Session::OwnQuestion& question);
void drawGraph(const FrameTimes& times);

}  // namespace lambent::viewer
