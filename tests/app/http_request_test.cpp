// Requests for the live page, byte by byte.
#include "app/camera/http_request.h"

#include <gtest/gtest.h>

#include <string>
#include <variant>

namespace spincat::app {
namespace {

HttpRequest read(const std::string& head) {
  const auto parsed = parse_request(head);
  EXPECT_TRUE(std::holds_alternative<HttpRequest>(parsed)) << head;
  return std::holds_alternative<HttpRequest>(parsed) ? std::get<HttpRequest>(parsed) : HttpRequest{};
}

int status_of(const std::string& head) {
  const auto parsed = parse_request(head);
  return std::holds_alternative<int>(parsed) ? std::get<int>(parsed) : 200;
}

TEST(HttpRequest, EndsWithAnEmptyLine) {
  EXPECT_FALSE(head_length(""));
  EXPECT_FALSE(head_length("GET / HTTP/1.1\r\nHost: a\r\n"));
  EXPECT_EQ(head_length("GET / HTTP/1.1\r\n\r\n"), 18U);
  EXPECT_EQ(head_length("GET / HTTP/1.1\r\n\r\nGET"), 18U);
}

TEST(HttpRequest, HasAPathAQueryAndAHost) {
  const HttpRequest request =
      read("GET /frame?after=12&token=ab=c&&x HTTP/1.1\r\nhOST: \t [::1]:80 \r\nA: b:c\r\n\r\n");
  EXPECT_EQ(request.path, "/frame");
  EXPECT_EQ(request.value("after"), "12");
  EXPECT_EQ(request.value("token"), "ab=c");
  EXPECT_EQ(request.value("x"), "");
  EXPECT_EQ(request.value("nothing"), "");
  EXPECT_EQ(request.host, "[::1]:80");
  EXPECT_EQ(read("GET /?token=a&token=b HTTP/1.1\r\n\r\n").value("token"), "a");
  EXPECT_EQ(read("GET / HTTP/1.1\r\n\r\n").host, "");
}

TEST(HttpRequest, StaysOpenUnlessItIsSaid) {
  EXPECT_TRUE(read("GET / HTTP/1.1\r\n\r\n").stays_open);
  EXPECT_FALSE(read("GET / HTTP/1.1\r\nConnection: Close\r\n\r\n").stays_open);
  EXPECT_FALSE(read("GET / HTTP/1.0\r\n\r\n").stays_open);
}

TEST(HttpRequest, TellsPagesOfOtherSites) {
  const auto is_other = [](const std::string& site) {
    return read("GET / HTTP/1.1\r\nSec-Fetch-Site: " + site + "\r\n\r\n").is_of_other_site;
  };
  EXPECT_TRUE(is_other("cross-site"));
  EXPECT_TRUE(is_other("same-site"));
  EXPECT_FALSE(is_other("same-origin"));
  EXPECT_FALSE(is_other("none"));
}

TEST(HttpRequest, IsRefusedWithAStatus) {
  EXPECT_EQ(status_of("GET / HTTP/1.1\r\nContent-Length: 0\r\n\r\n"), 200);
  EXPECT_EQ(status_of("GET / HTTP/1.1\r\nContent-Length: 5\r\n\r\n"), 413);
  EXPECT_EQ(status_of("GET / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n"), 413);
  EXPECT_EQ(status_of("POST / HTTP/1.1\r\n\r\n"), 405);
  EXPECT_EQ(status_of("GET / HTTP/2.0\r\n\r\n"), 505);
  for (const char* head :
       {"", "\r\n", "\r\n\r\n", "GET", "GET /", "GET / \r\n\r\n", "GET frame HTTP/1.1\r\n\r\n",
        "GET / HTTP/1.1 x\r\n\r\n", "GET  / HTTP/1.1\r\n\r\n", "GET / HTTP/1.1\r\nHost: a\r\nHost: a\r\n\r\n",
        "GET / HTTP/1.1\r\nHost\r\n\r\n", "GET / HTTP/1.1\r\n: a\r\n\r\n", "GET / HTTP/1.1\r\nHost : a\r\n\r\n",
        "GET / HTTP/1.1\r\n folded: a\r\n\r\n"}) {
    EXPECT_GE(status_of(head), 400) << head;
  }
}

TEST(HttpRequest, GetsAnAnswerWithItsLength) {
  const std::string head = answer_head(200, "text/plain", 12, true);
  EXPECT_TRUE(head.starts_with(
      "HTTP/1.1 200 OK\r\nConnection: keep-alive\r\nContent-Type: text/plain\r\nContent-Length: 12\r\n"))
      << head;
  EXPECT_EQ(head_length(head), head.size());
  EXPECT_TRUE(
      answer_head(204, "", 0, false).starts_with("HTTP/1.1 204 No Content\r\nConnection: close\r\nCache-Control:"));
}

}  // namespace
}  // namespace spincat::app
