// The live page: a small web server that shows what the camera sees.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/camera/camera_state.h"
#include "app/camera/page_server.h"

namespace spincat::app {

// Where the page is served.
struct ViewPlace {
  std::string address = "127.0.0.1";
  int port = 0;  // 0: any that is free

  // "8080", "0.0.0.0:8080" or "[::1]:8080". Throws InputError when it is none of them.
  static ViewPlace parse(const std::string& text);
};

// Serves until it goes, and then ends at once. However many clients there are, and however slow or large what they
// send, they cost the loop nothing and no more memory than PageServer says. On an address that others can reach, only
// those who know the token in url() are answered; on a local one, only pages of this very server are (no other site's
// page can ask for the pictures).
class LiveView {
 public:
  // Throws RunError when the place cannot be had, or there is no thread for it. What is referred to must outlive it.
  LiveView(const ViewPlace& place, const CameraState& state, const std::vector<std::string>& categories);
  ~LiveView();
  LiveView(const LiveView&) = delete;
  LiveView& operator=(const LiveView&) = delete;

  const std::string& url() const;

 private:
  struct Pages;
  std::unique_ptr<Pages> pages_;
  std::optional<PageServer> server_;  // the last member: it asks for pages
};

}  // namespace spincat::app
