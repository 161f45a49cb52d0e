// The answer to one object, with what is needed to show and explain it.
#pragma once

#include <spincat/spincat.h>

#include <optional>
#include <string>

#include "objects.h"

namespace spincat::python {

// Python's class Ballot.
struct NamedItem {
  Model model;
  Item item;
  Classification answer;
  double reject = 0.0;  // how known an object has to be, else its name is not given

  bool is_unknown() const { return answer.known < reject; }
  const std::string& winner() const { return model.categories()[answer.ballot.winner]; }
};

}  // namespace spincat::python
