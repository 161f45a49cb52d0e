// What a browser asks for: the part of HTTP/1.1 that the live page needs.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace spincat::app {

struct HttpRequest {
  std::string path;  // without what follows the '?'
  std::map<std::string, std::string, std::less<>> query;
  std::string host;               // empty where it is not said
  bool stays_open = false;        // for another request
  bool is_of_other_site = false;  // asked for by a page of another server

  // Of the query; empty where it is not there.
  std::string_view value(std::string_view name) const;
};

// The length of a request's head with the empty line at its end; nothing where that has not come yet.
std::optional<std::size_t> head_length(std::string_view bytes);

// A request for a page (GET, without a body), or the status to refuse it with.
std::variant<HttpRequest, int> parse_request(std::string_view head);

// The head of an answer, up to the empty line.
std::string answer_head(int status, std::string_view type, std::size_t length, bool stays_open);

}  // namespace spincat::app
