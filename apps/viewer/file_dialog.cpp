#include "apps/viewer/file_dialog.h"

#include <exception>

#include "apps/viewer/portal.h"

namespace lambent::viewer {

void FileDialog::ask(FileQuestion question) {
  giveUp();
  asked_ = std::make_unique<Asked>();
  asked_->question = std::move(question);
  asked_->thread = std::jthread([asked = asked_.get(), window = window_](std::stop_token stop) {
    FileAnswer answer;
    try {
      answer = askPortal(asked->question, window, stop);
    } catch (const std::exception& e) {
      answer = {FileAnswer::How::Failed, {}, e.what()};
    }
    const std::lock_guard lock(asked->mutex);
    asked->answer = std::move(answer);
  });
}

std::optional<std::pair<FileQuestion, FileAnswer>> FileDialog::take() {
  if (!asked_) return std::nullopt;
  {
    const std::lock_guard lock(asked_->mutex);
    if (!asked_->answer) return std::nullopt;
  }
  asked_->thread.join();
  std::pair taken(std::move(asked_->question), std::move(*asked_->answer));
  asked_.reset();
  return taken;
}

}  // namespace lambent::viewer
