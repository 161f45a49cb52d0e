// What two reports of the same work have in common.
#pragma once

#include <cstddef>
#include <cstring>
#include <string>

namespace spincat::test {

// A page without the times and the command line of its run.
inline std::string lasting_part(std::string page) {
  for (const char* const key : {"\"milliseconds\":", "\"command\":["}) {
    for (std::size_t at = page.find(key); at != std::string::npos; at = page.find(key, at + 1)) {
      const std::size_t begin = at + std::strlen(key);
      page.erase(begin, page.find_first_of("}]", begin) - begin);
    }
  }
  return page;
}

}  // namespace spincat::test
