#include "spincat/io/formats/xml.h"

#include <expat.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <utility>

#include "spincat/error.h"

namespace spincat::io {
namespace {

constexpr char kSeparator = '\x1F';  // between a namespace and a name: no name has it

// expat keeps every name that it has ever seen, and all of a word until that ends. Its memory is counted, as it asks
// for it, by the parser that is at work in this thread.
thread_local std::int64_t* used_memory = nullptr;
constexpr std::int64_t kMostMemory = 6'000'000;
constexpr std::size_t kBefore = alignof(std::max_align_t);  // where the size of a block stands

void* counted_realloc(void* block, std::size_t size) {
  auto* begin = block == nullptr ? nullptr : static_cast<char*>(block) - kBefore;
  std::size_t before = 0;
  if (begin != nullptr) {
    std::memcpy(&before, begin, sizeof(before));
  }
  const std::int64_t more = static_cast<std::int64_t>(size) - static_cast<std::int64_t>(before);
  if (size > kMostMemory || (used_memory != nullptr && *used_memory + more > kMostMemory)) {
    return nullptr;
  }
  begin = static_cast<char*>(std::realloc(begin, size + kBefore));
  if (begin == nullptr) {
    return nullptr;
  }
  if (used_memory != nullptr) {
    *used_memory += more;
  }
  std::memcpy(begin, &size, sizeof(size));
  return begin + kBefore;
}

void* counted_malloc(std::size_t size) {
  return counted_realloc(nullptr, size);
}

void counted_free(void* block) {
  if (block == nullptr) {
    return;
  }
  auto* begin = static_cast<char*>(block) - kBefore;
  std::size_t size = 0;
  std::memcpy(&size, begin, sizeof(size));
  if (used_memory != nullptr) {
    *used_memory -= static_cast<std::int64_t>(size);
  }
  std::free(begin);
}

constexpr XML_Memory_Handling_Suite kMemory = {counted_malloc, counted_realloc, counted_free};

std::pair<std::string_view, std::string_view> space_and_name(std::string_view full) {
  const std::size_t at = full.find(kSeparator);
  return at == std::string_view::npos ? std::pair(std::string_view(), full)
                                      : std::pair(full.substr(0, at), full.substr(at + 1));
}

}  // namespace

std::optional<std::string_view> XmlAttributes::find(std::string_view name) const {
  for (const char** pair = pairs_; *pair != nullptr; pair += 2) {
    if (space_and_name(*pair).second == name) {
      return pair[1];
    }
  }
  return std::nullopt;
}

struct XmlParser::State {
  XmlHandler& handler;
  XML_Parser parser = nullptr;
  std::int64_t memory = 0;
  std::exception_ptr thrown;  // no exception goes through expat

  // Runs one of the handler's functions, whose exception ends the parsing.
  template <class Run>
  void guarded(Run run) {
    if (thrown != nullptr) {
      return;
    }
    try {
      run();
    } catch (const InputError& problem) {
      thrown = std::make_exception_ptr(
          InputError(fmt::format("line {}: {}", XML_GetCurrentLineNumber(parser), problem.problem())));
    } catch (...) {
      thrown = std::current_exception();
    }
    if (thrown != nullptr) {
      XML_StopParser(parser, XML_FALSE);
    }
  }

  static void begin(void* self, const char* name, const char** attributes) {
    auto* state = static_cast<State*>(self);
    const auto [space, local] = space_and_name(name);
    state->guarded([&, in = space, tag = local] { state->handler.begin(in, tag, XmlAttributes(attributes)); });
  }
  static void end(void* self, const char* name) {
    auto* state = static_cast<State*>(self);
    const auto [space, local] = space_and_name(name);
    state->guarded([&, in = space, tag = local] { state->handler.end(in, tag); });
  }
  // Nothing that is read here has definitions of its own, which may be made to grow.
  static void types(void* self, const char*, const char*, const char*, int) {
    auto* state = static_cast<State*>(self);
    state->guarded([] { throw InputError("holds a document type definition, which spincat does not read"); });
  }
};

XmlParser::XmlParser(XmlHandler& handler) : state_(new State{handler, nullptr, 0, nullptr}) {
  used_memory = &state_->memory;
  const char separator[] = {kSeparator, '\0'};
  state_->parser = XML_ParserCreate_MM(nullptr, &kMemory, separator);
  used_memory = nullptr;
  if (state_->parser == nullptr) {
    throw std::bad_alloc();
  }
  XML_SetUserData(state_->parser, state_.get());
  XML_SetElementHandler(state_->parser, State::begin, State::end);
  XML_SetStartDoctypeDeclHandler(state_->parser, State::types);
}

XmlParser::~XmlParser() {
  used_memory = &state_->memory;
  XML_ParserFree(state_->parser);
  used_memory = nullptr;
}

void XmlParser::feed(std::string_view piece) {
  constexpr std::size_t kAtOnce = 1 << 16;
  while (!piece.empty()) {
    parse(piece.substr(0, kAtOnce), false);
    piece.remove_prefix(std::min(kAtOnce, piece.size()));
  }
}

void XmlParser::finish() {
  parse({}, true);
}

void XmlParser::parse(std::string_view piece, bool is_last) {
  used_memory = &state_->memory;
  const XML_Status status = XML_Parse(state_->parser, piece.data(), static_cast<int>(piece.size()), is_last ? 1 : 0);
  used_memory = nullptr;
  if (state_->thrown != nullptr) {
    std::rethrow_exception(state_->thrown);
  }
  if (status == XML_STATUS_OK) {
    return;
  }
  const XML_Error error = XML_GetErrorCode(state_->parser);
  throw InputError(fmt::format("line {}: {}", XML_GetCurrentLineNumber(state_->parser),
                               error == XML_ERROR_NO_MEMORY
                                   ? "names, words or nesting beyond all bounds"
                                   : fmt::format("no valid XML ({})", XML_ErrorString(error))));
}

}  // namespace spincat::io
