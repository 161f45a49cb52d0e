#include "spincat/camera/source/depth_list.h"

#include "spincat/io/text_cursor.h"

namespace spincat {

FrameList parse_depth_list(std::string_view text) {
  FrameList frames;
  io::TextCursor words(text, {.hash_comments = false});  // a name may have one
  while (words.word_follows()) {
    if (words.peek().front() == '#') {
      words.skip_line();
      continue;
    }
    const double time = words.finite_number("a time");
    const std::string_view file = words.word();
    if (file.empty()) {
      words.fail("expected a file behind the time");
    }
    frames.push_back({std::string(file), time});
    words.skip_line();
  }
  return frames;
}

}  // namespace spincat
