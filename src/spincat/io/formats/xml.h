// XML as it streams by, with expat. Private to io.
#pragma once

#include <memory>
#include <optional>
#include <string_view>

namespace spincat::io {

// The attributes of an element.
class XmlAttributes {
 public:
  explicit XmlAttributes(const char** pairs) : pairs_(pairs) {}

  // By its name, whatever its namespace; none where there is none.
  std::optional<std::string_view> find(std::string_view name) const;

 private:
  const char** pairs_;
};

class XmlHandler {
 public:
  virtual ~XmlHandler() = default;
  // name: without its namespace, which comes apart; empty where there is none.
  virtual void begin(std::string_view space, std::string_view name, const XmlAttributes& attributes) = 0;
  virtual void end(std::string_view space, std::string_view name) = 0;
};

// Takes no more memory than a few megabytes, however long the text: names, nesting and words are bounded by that.
class XmlParser {
 public:
  explicit XmlParser(XmlHandler& handler);
  ~XmlParser();
  XmlParser(const XmlParser&) = delete;
  XmlParser& operator=(const XmlParser&) = delete;

  // Throws InputError with the line where the text is no XML or the handler throws one.
  void feed(std::string_view piece);
  void finish();

 private:
  struct State;
  void parse(std::string_view piece, bool is_last);

  std::unique_ptr<State> state_;
};

}  // namespace spincat::io
