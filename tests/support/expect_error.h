// The whole message of an error, so that tests compare what a user reads.
#pragma once

#include <gtest/gtest.h>

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

// Expects an error of a type whose line contains a text.
template <class TableTicket, class Call>
void expect_error(Call call, const std::string& text) {
  try {
    call();
    ADD_FAILURE() << "no error where one with '" << text << "' is expected";
  } catch (const TableTicket& error) {
    EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
  }
}

}  // namespace spincat::test
