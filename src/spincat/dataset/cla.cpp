// The classification files of the Princeton Shape Benchmark:
//
//   PSB 1
//   3 2                     so many classes and so many models in all
//
//   seat 0 0                name, parent (0 is the root), number of models
//
//   chair seat 2
//   811
//   812
//
//   stool seat 0
#include <fmt/format.h>

#include <charconv>
#include <string_view>
#include <system_error>
#include <unordered_map>

#include "spincat/dataset/listing.h"
#include "spincat/dataset/words.h"
#include "spincat/error.h"
#include "spincat/files/file.h"

namespace spincat {
namespace {

constexpr std::string_view kRoot = "0";

// A word of the file and the line it stands in; at the end of the file the word is empty.
struct Word {
  std::string_view text;
  std::size_t line = 0;
};

class Words {
 public:
  explicit Words(std::string_view text) : text_(text) { skip_space(); }

  Word peek() const { return {text_.substr(0, text_.find_first_of(kSpace)), line_}; }

  Word next() {
    const Word word = peek();
    text_.remove_prefix(word.text.size());
    skip_space();
    return word;
  }

  std::size_t bytes_left() const { return text_.size(); }

 private:
  static constexpr std::string_view kSpace = " \t\r\n\f\v";

  void skip_space() {
    while (!text_.empty() && kSpace.find(text_.front()) != std::string_view::npos) {
      line_ += text_.front() == '\n' ? 1 : 0;
      text_.remove_prefix(1);
    }
  }

  std::string_view text_;
  std::size_t line_ = 1;
};

class ClaReader {
 public:
  ClaReader(std::string_view text, std::filesystem::path models, std::string split, ListBuilder& list)
      : words_(text), models_(std::move(models)), split_(std::move(split)), list_(list) {}

  void read() {
    read_magic();
    const std::size_t counts_line = words_.peek().line;
    const std::uint32_t classes = read_count("the number of classes", 2 * 3);  // "a 0 0"
    const std::uint32_t models = read_count("the number of models", 2);
    for (std::uint32_t i = 0; i < classes; ++i) {
      read_class(fmt::format("class {} of {}", i + 1, classes));
    }
    if (const Word rest = words_.peek(); !rest.text.empty()) {
      fail(rest.line, fmt::format("expected the end of the file after {} classes, found {}", classes, found(rest)));
    }
    if (list_.objects() != models) {
      fail(counts_line, fmt::format("announces {} models, but the classes list {}", models, list_.objects()));
    }
  }

 private:
  [[noreturn]] void fail(std::size_t line, std::string_view problem) const {
    throw InputError(list_.source().string(), at_line(line, problem));
  }

  static std::string found(const Word& word) {
    return word.text.empty() ? "the end of the file" : in_quotes(word.text);
  }

  void read_magic() {
    for (const std::string_view expected : {"PSB", "1"}) {
      const Word word = words_.next();
      if (word.text != expected) {
        fail(word.line, fmt::format("is no Princeton classification file: expected 'PSB 1', found {}", found(word)));
      }
    }
  }

  std::uint32_t read_number(std::string_view what) {
    const Word word = words_.next();
    const char* const end = word.text.data() + word.text.size();
    std::uint32_t number = 0;
    const auto [stop, error] = std::from_chars(word.text.data(), end, number);
    if (error == std::errc::result_out_of_range) {
      fail(word.line, fmt::format("expected {}, found {}, which is too large", what, found(word)));
    }
    if (error != std::errc() || stop != end) {
      fail(word.line, fmt::format("expected {}, found {}", what, found(word)));
    }
    return number;
  }

  // A number of things to come, each at least `bytes` long with the space after it.
  std::uint32_t read_count(std::string_view what, std::size_t bytes) {
    const Word word = words_.peek();
    const std::uint32_t count = read_number(what);
    if (count > words_.bytes_left() / bytes + 1) {
      fail(word.line, fmt::format("{} is {}, but only {} bytes follow", what, count, words_.bytes_left()));
    }
    return count;
  }

  void read_class(const std::string& which) {
    const Word name = words_.next();
    const Word parent = words_.peek();
    if (name.text.empty() || parent.text.empty() || parent.line != name.line) {
      fail(name.line, fmt::format("expected {} as NAME PARENT COUNT, found {}", which, found(name)));
    }
    words_.next();
    add_class(name, parent);
    const std::string called = in_quotes(name.text);
    const std::uint32_t models = read_count(fmt::format("the number of models of class {}", called), 2);
    for (std::uint32_t i = 0; i < models; ++i) {
      add_model(read_number(fmt::format("model number {} of {} in class {}", i + 1, models, called)));
    }
  }

  // A parent comes before its children, so that there can be no cycles.
  void add_class(const Word& name, const Word& parent) {
    if (name.text == kRoot) {
      fail(name.line, "a class cannot be called 0, which is the root");
    }
    ListedClass listed{std::string(name.text), std::nullopt};
    if (parent.text != kRoot) {
      const auto above = class_of_name_.find(std::string(parent.text));
      if (above == class_of_name_.end()) {
        fail(parent.line, fmt::format("the parent {} of class {} is not declared above it", in_quotes(parent.text),
                                      in_quotes(name.text)));
      }
      listed.parent = above->second;
    }
    if (!class_of_name_.emplace(listed.name, list_.classes()).second) {
      fail(name.line, fmt::format("class {} is declared twice", in_quotes(name.text)));
    }
    list_.add_class(std::move(listed));
  }

  void add_model(std::uint32_t number) {
    const std::string name = fmt::format("m{}", number);
    list_.add_object({models_ / std::to_string(number / 100) / name / (name + ".off"), list_.classes() - 1, split_});
  }

  Words words_;
  std::filesystem::path models_;
  std::string split_;
  ListBuilder& list_;
  std::unordered_map<std::string, std::uint32_t> class_of_name_;
};

// As the benchmark lies on the disk: classification/train.cla and db/, or both in one folder.
std::filesystem::path find_models(const std::filesystem::path& file) {
  const std::filesystem::path beside = file.parent_path();
  for (const std::filesystem::path& models : {beside / ".." / "db", beside / "db"}) {
    std::error_code error;
    if (std::filesystem::is_directory(models, error)) {
      // "a/../db" reads better as "db", but is another folder where a is a symbolic link.
      const std::filesystem::path tidy = models.lexically_normal();
      return std::filesystem::equivalent(tidy, models, error) ? tidy : models;
    }
  }
  throw InputError(file.string(),
                   "its models are not found: expected them in ../db or db beside it, or a folder named");
}

}  // namespace

Listing list_cla(const std::filesystem::path& file, const std::filesystem::path& models, const ReadLimits& limits) {
  const std::string text = read_file(file);
  ListBuilder list(file, text.size(), limits);
  const std::string stem = file.stem().string();
  const std::string split = stem == "train" || stem == "test" ? stem : "";
  ClaReader(text, models.empty() ? find_models(file) : models, split, list).read();
  return list.take();
}

}  // namespace spincat
