// The whole error vocabulary of the library: two exceptions.
//
// The library never prints, exits or aborts; whatever goes wrong arrives as one of these, with one line that says which
// file (where one is known), what was found and what was expected.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#pragma GCC visibility push(default)
namespace spincat {

// Base of both. what() is the whole line: "FILE: what is wrong", or only "what is wrong" where no file is known yet.
class Error : public std::runtime_error {
 public:
  Error(std::string file, std::string problem)
      : std::runtime_error(file.empty() ? problem : file + ": " + problem),
        file_(std::move(file)),
        problem_(std::move(problem)) {}

  const std::string& file() const { return file_; }        // may be empty
  const std::string& problem() const { return problem_; }  // one line, without the file

 private:
  std::string file_;
  std::string problem_;
};

// What was handed in is bad or was used wrongly: a damaged file, a setting out of its range. The command exits with 2.
class InputError : public Error {
 public:
  explicit InputError(std::string problem) : Error("", std::move(problem)) {}
  InputError(std::string file, std::string problem) : Error(std::move(file), std::move(problem)) {}
};

// The input is fine but the work could not be done: disk full, no permission. The command exits with 1.
class RunError : public Error {
 public:
  explicit RunError(std::string problem) : Error("", std::move(problem)) {}
  RunError(std::string file, std::string problem) : Error(std::move(file), std::move(problem)) {}
};

}  // namespace spincat
#pragma GCC visibility pop
