// What the system says of a failure, in the words of our messages.
#pragma once

#include <cerrno>
#include <string>
#include <system_error>

namespace spincat {

// What an errno value means, in the lower case of our one-line messages.
inline std::string system_error_text(int error) {
  if (error == ENOENT) {
    return "no such file";
  }
  std::string text = std::generic_category().message(error);
  // "Permission denied", but not "I/O error"
  if (text.size() > 1 && text[0] >= 'A' && text[0] <= 'Z' && text[1] >= 'a') {
    text[0] = static_cast<char>(text[0] + 32);
  }
  return text;
}

}  // namespace spincat
