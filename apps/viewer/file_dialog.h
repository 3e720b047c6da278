// The desktop's file dialog beside a window that goes on drawing.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "apps/viewer/file_question.h"

namespace lambent::viewer {

class FileDialog {
 public:
  /// The window that dialogs belong to, as askPortal() has it.
  void setWindow(std::string name) { window_ = std::move(name); }

  /// Asks on a thread of its own. What was asked before and is not answered yet is given up.
  void ask(FileQuestion question);
  /// Closes the dialog; nobody hears of it again.
  void giveUp() { asked_.reset(); }
  bool waiting() const { return asked_ != nullptr; }

  /// The question with its answer, once there is one.
  std::optional<std::pair<FileQuestion, FileAnswer>> take();

 private:
  struct Asked {
    FileQuestion question;
    std::mutex mutex;
    std::optional<FileAnswer> answer;
    std::jthread thread;  // last: it ends before what it uses goes
  };
  std::string window_;
  std::unique_ptr<Asked> asked_;
};

}  // namespace lambent::viewer
