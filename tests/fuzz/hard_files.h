// Files made to be hard on a reader: as much to keep as can be said in so many bytes.
#pragma once

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <ostream>
#include <string>
#include <vector>

namespace spincat::test {

struct Hard {
  std::string reader;                                 // as in fuzz/readers.h
  std::string name;                                   // what the file is full of
  std::function<std::string(std::size_t size)> make;  // its bytes, about so many
};

std::vector<Hard> hard_files();

// For the names of tests.
std::ostream& operator<<(std::ostream& stream, const Hard& hard);

}  // namespace spincat::test
