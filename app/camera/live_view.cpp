#include "app/camera/live_view.h"

#include <fmt/format.h>
#include <httplib.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <string_view>
#include <thread>

#include "spincat/error.h"
#include "spincat/report/embedded.h"

namespace spincat::app {
namespace {

constexpr std::chrono::milliseconds kLongestWait(1'000);  // of a page for the next frame
constexpr int kMostColumns = 320;                         // of the picture that the page gets

// The picture as the page gets it: every step-th pixel both ways.
struct SmallPicture {
  int width = 0;
  int height = 0;
  std::string grey;  // near is bright; 0: no reading
  std::string ids;   // 1 + the place of the object in the list of objects, 0 for none
};

SmallPicture thumbnail(const ShownFrame& frame) {
  const DepthImage& image = frame.image;
  const int step = std::max(1, image.width / kMostColumns);
  SmallPicture small{image.width / step, image.height / step, {}, {}};
  float nearest = 1e9F;
  float furthest = 0.0F;
  for (const float z : image.depth) {
    if (z > 0.0F) {
      nearest = std::min(nearest, z);
      furthest = std::max(furthest, z);
    }
  }
  const float scale = 200.0F / std::max(furthest - nearest, 1e-3F);
  for (int v = 0; v < small.height; ++v) {
    for (int u = 0; u < small.width; ++u) {
      const std::size_t i = image.index(u * step, v * step);
      const float z = image.depth[i];
      small.grey.push_back(z > 0.0F ? static_cast<char>(255.0F - (z - nearest) * scale) : '\0');
      const std::uint16_t id = frame.seen.segmentation.ids.empty() ? 0 : frame.seen.segmentation.ids[i];
      small.ids.push_back(static_cast<char>(std::min<int>(id, 255)));
    }
  }
  return small;
}

void append_number(std::string& bytes, std::uint32_t number) {
  for (int shift = 0; shift < 32; shift += 8) {
    bytes.push_back(static_cast<char>(number >> shift & 0xFFU));
  }
}

// What the page asks for again and again: the frame's JSON and its small picture. Five numbers of four bytes, the
// lowest first: which frame this is, frames a second times 10, the length of the JSON, width and height; then the JSON,
// the grey values and the ids.
std::string frame_bytes(const CameraState::Shown& shown, const std::vector<std::string>& categories) {
  const ShownFrame& frame = *shown.frame;
  const std::string json = frame_json(frame.facts, frame.seen, categories);
  const SmallPicture small = thumbnail(frame);
  std::string bytes;
  append_number(bytes, static_cast<std::uint32_t>(shown.number));
  append_number(bytes, static_cast<std::uint32_t>(10.0 * frame.frames_a_second));
  append_number(bytes, static_cast<std::uint32_t>(json.size()));
  append_number(bytes, static_cast<std::uint32_t>(small.width));
  append_number(bytes, static_cast<std::uint32_t>(small.height));
  return bytes + json + small.grey + small.ids;
}

std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw RunError("no random numbers for the live page's token");
  }
  std::string token;
  for (const unsigned char byte : bytes) {
    token += fmt::format("{:02x}", byte);
  }
  return token;
}

std::uint64_t number_of(const httplib::Request& request, const char* name) {
  const std::string text = request.get_param_value(name);
  std::uint64_t number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

// Equal in a time that does not tell where they differ.
bool same_text(const std::string& a, const std::string& b) {
  unsigned char difference = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    difference |= static_cast<unsigned char>(a[i] ^ b[i]);
  }
  return difference == 0;
}

}  // namespace

ViewPlace ViewPlace::parse(const std::string& text) {
  ViewPlace place;
  const std::size_t colon = text.rfind(':');
  const std::string_view port = std::string_view(text).substr(colon == std::string::npos ? 0 : colon + 1);
  if (colon != std::string::npos) {
    place.address = text.substr(0, colon);
  }
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), place.port);
  if (error != std::errc{} || end != port.data() + port.size() || place.port < 0 || place.port > 65'535 ||
      place.address.empty()) {
    throw InputError(fmt::format("--view {}: expected a port from 0 to 65535, or ADDRESS:PORT", text));
  }
  return place;
}

bool ViewPlace::is_local() const {
  return address.rfind("127.", 0) == 0 || address == "localhost";
}

struct LiveView::Server {
  Server(const ViewPlace& where, const CameraState& shown, const std::vector<std::string>& names)
      : place(where), state(shown), categories(names) {
    if (!place.is_local()) {
      token = random_token();
    }
    http.new_task_queue = [] { return new httplib::ThreadPool(4); };  // as httplib wants it; it deletes the pool
    http.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      if (allowed(request)) {
        return httplib::Server::HandlerResponse::Unhandled;
      }
      response.status = 403;
      response.set_content("This page needs the token that spincat camera printed.\n", "text/plain");
      return httplib::Server::HandlerResponse::Handled;
    });
    http.set_default_headers({{"Cache-Control", "no-store"},
                              {"X-Content-Type-Options", "nosniff"},
                              {"Content-Security-Policy",
                               "default-src 'none'; connect-src 'self'; style-src 'unsafe-inline'; script-src "
                               "'unsafe-inline'; img-src data:"}});
    http.Get("/", [](const httplib::Request&, httplib::Response& response) {
      const std::string_view page = embedded::live_html();
      response.set_content(page.data(), page.size(), "text/html; charset=utf-8");
    });
    http.Get("/frame", [this](const httplib::Request& request, httplib::Response& response) {
      lower_priority();
      const CameraState::Shown newest = state.newer_than(number_of(request, "after"), kLongestWait);
      if (newest.frame) {
        response.set_content(frame_bytes(newest, categories), "application/octet-stream");
      } else {
        response.status = newest.ended ? 410 : 204;
      }
    });
  }

  void start() {
    if (place.port == 0) {
      place.port = http.bind_to_any_port(place.address.c_str());
    } else if (!http.bind_to_port(place.address.c_str(), place.port)) {
      place.port = -1;
    }
    if (place.port < 0) {
      throw RunError(fmt::format("the live page cannot be served on {}: {}", place.address, std::strerror(errno)));
    }
    url = fmt::format("http://{}:{}/{}", place.address, place.port, token.empty() ? "" : "?token=" + token);
    thread = std::jthread([this] { http.listen_after_bind(); });
  }

  // A name that leads here but is not ours is another site's trick to read what is local (DNS rebinding).
  bool allowed(const httplib::Request& request) const {
    if (!token.empty()) {
      return same_text(request.get_param_value("token"), token);
    }
    const std::string host = request.get_header_value("Host");
    return host == fmt::format("{}:{}", place.address, place.port) || host == fmt::format("localhost:{}", place.port);
  }

  ViewPlace place;
  const CameraState& state;
  const std::vector<std::string>& categories;
  std::string token;
  std::string url;
  httplib::Server http;
  std::jthread thread;
};

LiveView::LiveView(const ViewPlace& place, const CameraState& state, const std::vector<std::string>& categories)
    : server_(std::make_unique<Server>(place, state, categories)) {
  server_->start();
}

LiveView::~LiveView() {
  server_->http.stop();
}

const std::string& LiveView::url() const {
  return server_->url;
}

}  // namespace spincat::app
