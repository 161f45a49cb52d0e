// A web server on one thread. What it holds for its clients and how long it waits for them is bounded: thirty-two
// connections, requests of 8 kB, five seconds for a request and ten for taking an answer. Whoever comes when all are
// taken gets the place of the one who has been silent longest.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "app/camera/http_request.h"
#include "app/camera/listener.h"

namespace spincat::app {

struct PageAnswer {
  int status = 200;
  std::string_view type = "text/plain";     // of a text that stays
  std::shared_ptr<const std::string> body;  // may be the same for many
};

// What a request gets; nothing where there is nothing yet: then it is asked again soon. `waited`: how long it has been
// asked so. Called from the server's thread.
using PageHandler = std::function<std::optional<PageAnswer>(const HttpRequest&, std::chrono::milliseconds waited)>;

class PageServer {
 public:
  // Serves from now on. Throws RunError where there is no thread for it.
  PageServer(Listener listener, PageHandler handler);
  // Ends at once, whatever clients do; those who wait are answered first, as if they had waited for ever.
  ~PageServer();
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

 private:
  class Loop;
  std::unique_ptr<Loop> loop_;
};

}  // namespace spincat::app
