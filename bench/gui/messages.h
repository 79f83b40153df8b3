#pragma once

#include <string>
#include <vector>

namespace hlodbench {

// What the user is told in the window; on stderr, too.
class Messages {
 public:
  void tell(const std::string& text);  // goes by itself
  void warn(const std::string& text);  // stays until it is clicked away
  // At the foot of the view, whose left edge is at x; pixels.
  void show(float x);

 private:
  struct Message {
    std::string text;
    bool isWarning;
    double time;  // seconds
  };
  std::vector<Message> messages_;
};

}  // namespace hlodbench
