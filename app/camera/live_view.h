// The live page: a small web server that shows what the camera sees.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/camera/camera_state.h"

namespace spincat::app {

// Where the page is served.
struct ViewPlace {
  std::string address = "127.0.0.1";
  int port = 0;  // 0: any that is free

  // "8080" or "0.0.0.0:8080". Throws InputError when it is neither.
  static ViewPlace parse(const std::string& text);
  bool is_local() const;
};

// Serves until it goes. On an address that others can reach, only those who know the token in url() are answered; on a
// local one, only pages of this very server are (no other site's page can ask for the pictures).
class LiveView {
 public:
  // Throws RunError when the place cannot be had. What is referred to must outlive it.
  LiveView(const ViewPlace& place, const CameraState& state, const std::vector<std::string>& categories);
  ~LiveView();
  LiveView(const LiveView&) = delete;
  LiveView& operator=(const LiveView&) = delete;

  const std::string& url() const;

 private:
  struct Server;
  std::unique_ptr<Server> server_;
};

}  // namespace spincat::app
