#include "app/camera/http_request.h"

#include <fmt/format.h>

#include <cstddef>
#include <utility>

namespace spincat::app {
namespace {

constexpr int kBadRequest = 400;
constexpr int kMethodNotAllowed = 405;
constexpr int kTooLarge = 413;
constexpr int kWrongVersion = 505;

// What stands before the separator, which is taken away with it; all where there is none.
std::string_view take_until(std::string_view& text, std::string_view separator) {
  const std::size_t at = text.find(separator);
  const std::string_view before = text.substr(0, at);
  text.remove_prefix(at == std::string_view::npos ? text.size() : at + separator.size());
  return before;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return lower;
}

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) {
    text.remove_prefix(1);
  }
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) {
    text.remove_suffix(1);
  }
  return text;
}

const char* reason_of(int status) {
  switch (status) {
    case 200:
      return "OK";
    case 204:
      return "No Content";
    case 403:
      return "Forbidden";
    case 404:
      return "Not Found";
    case 405:
      return "Method Not Allowed";
    case 410:
      return "Gone";
    case 413:
      return "Content Too Large";
    case 431:
      return "Request Header Fields Too Large";
    case 505:
      return "HTTP Version Not Supported";
    default:
      return "Bad Request";
  }
}

// Each header of the head by its name in lower case; nothing where a line is none, or there are two hosts.
std::optional<std::map<std::string, std::string>> headers_of(std::string_view lines) {
  std::map<std::string, std::string> headers;
  while (!lines.empty()) {
    std::string_view value = take_until(lines, "\r\n");
    if (value.empty()) {
      break;
    }
    const bool has_colon = value.find(':') != std::string_view::npos;
    const std::string name = lower_case(take_until(value, ":"));
    if (!has_colon || name.empty() || name.find_first_of(" \t") != std::string::npos ||
        (name == "host" && headers.contains(name))) {
      return {};
    }
    headers[name] = without_blanks(value);
  }
  return headers;
}

}  // namespace

std::string_view HttpRequest::value(std::string_view name) const {
  const auto found = query.find(name);
  return found != query.end() ? std::string_view(found->second) : std::string_view();
}

std::optional<std::size_t> head_length(std::string_view bytes) {
  constexpr std::string_view kEnd = "\r\n\r\n";
  const std::size_t at = bytes.find(kEnd);
  return at != std::string_view::npos ? std::optional(at + kEnd.size()) : std::nullopt;
}

std::variant<HttpRequest, int> parse_request(std::string_view head) {
  std::string_view first = take_until(head, "\r\n");
  const std::string_view method = take_until(first, " ");
  std::string_view target = take_until(first, " ");
  const std::string_view version = first;
  if (!target.starts_with('/') || !version.starts_with("HTTP/")) {
    return kBadRequest;
  }
  if (version != "HTTP/1.1" && version != "HTTP/1.0") {
    return kWrongVersion;
  }
  if (method != "GET") {
    return kMethodNotAllowed;
  }
  auto headers = headers_of(head);
  if (!headers) {
    return kBadRequest;
  }
  if (headers->contains("transfer-encoding") ||
      (headers->contains("content-length") && (*headers)["content-length"] != "0")) {
    return kTooLarge;  // nobody asks for a page with a body
  }
  HttpRequest request;
  request.path = take_until(target, "?");
  while (!target.empty()) {
    std::string_view value = take_until(target, "&");
    const std::string_view name = take_until(value, "=");
    request.query.try_emplace(std::string(name), value);
  }
  request.host = (*headers)["host"];
  request.stays_open = version == "HTTP/1.1" && lower_case((*headers)["connection"]) != "close";
  const std::string site = lower_case((*headers)["sec-fetch-site"]);
  request.is_of_other_site = site == "cross-site" || site == "same-site";
  return request;
}

std::string answer_head(int status, std::string_view type, std::size_t length, bool stays_open) {
  std::string head = fmt::format("HTTP/1.1 {} {}\r\nConnection: {}\r\n", status, reason_of(status),
                                 stays_open ? "keep-alive" : "close");
  if (status != 204) {
    head += fmt::format("Content-Type: {}\r\nContent-Length: {}\r\n", type, length);
  }
  return head +
         "Cache-Control: no-store\r\n"
         "X-Content-Type-Options: nosniff\r\n"
         "Content-Security-Policy: default-src 'none'; connect-src 'self'; style-src 'unsafe-inline'; script-src "
         "'unsafe-inline'; img-src data:\r\n\r\n";
}

}  // namespace spincat::app
