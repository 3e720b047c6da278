// What the viewer has to tell: problems, which want to be read, and remarks, which pass.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "lambent/report/result.h"

namespace lambent::viewer {

class Notices {
 public:
  void problem(const Error& error) { problems_.push_back(error); }
  /// Takes a failure in; true if there was none.
  bool check(const Status& status) {
    if (!status) problem(status.error());
    return bool(status);
  }
  /// Unless it is being shown.
  void remarkOnce(const std::string& text) {
    for (Remark& each : remarks_)
      if (each.text == text) {
        each.left = kShown;
        return;
      }
    remark(text);
  }
  void remark(std::string text) { remarks_.push_back({std::move(text), kShown}); }

  /// The oldest problem that nobody has put away yet.
  const Error* current() const { return problems_.empty() ? nullptr : &problems_.front(); }
  void putAway() {
    if (!problems_.empty()) problems_.pop_front();
  }

  struct Remark {
    std::string text;
    double left = 0.0;  ///< seconds that it is still shown
  };
  const std::vector<Remark>& remarks() const { return remarks_; }
  void pass(double seconds) {
    for (Remark& remark : remarks_) remark.left -= seconds;
    std::erase_if(remarks_, [](const Remark& remark) { return remark.left <= 0.0; });
  }

 private:
  static constexpr double kShown = 4.0;
  std::deque<Error> problems_;
  std::vector<Remark> remarks_;
};

}  // namespace lambent::viewer
