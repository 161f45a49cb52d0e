// The whole message of an error, so that tests compare what a user reads.
#pragma once

#include <string>

#include "spincat/error.h"

namespace spincat::test {

template <class Call>
std::string input_error(Call call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace spincat::test
