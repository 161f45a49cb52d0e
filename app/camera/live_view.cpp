#include "app/camera/live_view.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <string_view>
#include <utility>

#include "app/camera/page_server.h"
#include "spincat/error.h"
#include "spincat/report/embedded.h"

namespace spincat::app {
namespace {

constexpr std::chrono::milliseconds kLongestWait(1'000);  // of a page for the next frame
constexpr int kMostPixels = 320;                          // along a side of the picture that the page gets

// The picture as the page gets it: every step-th pixel both ways.
struct SmallPicture {
  int width = 0;
  int height = 0;
  std::string grey;  // near is bright; 0: no reading
  std::string ids;   // 1 + the place of the object in the list of objects, 0 for none
};

SmallPicture thumbnail(const ShownFrame& frame) {
  const DepthImage& image = frame.image;
  const int step = (std::max(image.width, image.height) + kMostPixels - 1) / kMostPixels;
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

std::uint64_t number_of(std::string_view text) {
  std::uint64_t number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

// Equal in a time that does not tell where they differ.
bool same_text(std::string_view a, std::string_view b) {
  unsigned char difference = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    difference |= static_cast<unsigned char>(a[i] ^ b[i]);
  }
  return difference == 0;
}

bool is_number_of_address(const std::string& text) {
  in6_addr ignored{};
  return inet_pton(AF_INET6, text.c_str(), &ignored) == 1;
}

bool same_name(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

}  // namespace

ViewPlace ViewPlace::parse(const std::string& text) {
  ViewPlace place;
  const std::size_t colon = text.rfind(':');
  const std::string_view port = std::string_view(text).substr(colon == std::string::npos ? 0 : colon + 1);
  if (colon != std::string::npos) {
    place.address = text.substr(0, colon);
  }
  const bool in_brackets = place.address.size() > 2 && place.address.front() == '[' && place.address.back() == ']';
  if (in_brackets) {
    place.address = place.address.substr(1, place.address.size() - 2);
  }
  const bool has_colon = place.address.find(':') != std::string::npos;
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), place.port);
  if (error != std::errc{} || end != port.data() + port.size() || place.port < 0 || place.port > 65'535 ||
      place.address.empty() || (has_colon && !in_brackets && !is_number_of_address(place.address))) {
    throw InputError(fmt::format(
        "--view {}: expected a port from 0 to 65535, or ADDRESS:PORT, as in 0.0.0.0:8080 or [::1]:8080", text));
  }
  return place;
}

struct LiveView::Pages {
  Pages(std::string where, const Listener& listener, const CameraState& shown, const std::vector<std::string>& names)
      : state(shown), categories(names) {
    const std::string address = where.find(':') != std::string::npos ? "[" + where + "]" : where;
    const std::string at = fmt::format("{}:{}", address, listener.port());
    if (listener.is_local()) {
      hosts = {at, fmt::format("localhost:{}", listener.port())};
      if (listener.port() == kUsualPort) {  // browsers leave it out
        hosts.insert(hosts.end(), {address, "localhost"});
      }
    } else {
      token = random_token();
    }
    url = fmt::format("http://{}/{}", at, token.empty() ? "" : "?token=" + token);
  }

  // A name that leads here but is not ours is another site's trick to read what is local (DNS rebinding).
  bool allowed(const HttpRequest& request) const {
    return token.empty() ? std::ranges::any_of(hosts, [&](const auto& host) { return same_name(host, request.host); })
                         : same_text(request.value("token"), token);
  }

  std::optional<PageAnswer> answer(const HttpRequest& request, std::chrono::milliseconds waited) {
    if (!allowed(request) || (request.is_of_other_site && request.path != "/")) {
      return PageAnswer{403, "text/plain", refusal};
    }
    if (request.path == "/") {
      return PageAnswer{200, "text/html; charset=utf-8", page};
    }
    return request.path == "/frame" ? frame(number_of(request.value("after")), waited)
                                    : PageAnswer{404, "text/plain", nullptr};
  }

  std::optional<PageAnswer> frame(std::uint64_t after, std::chrono::milliseconds waited) {
    const CameraState::Shown newest = state.newer_than(after, std::chrono::milliseconds(0));
    if (newest.frame) {
      if (newest.number != number) {  // once for all who ask
        bytes = std::make_shared<const std::string>(frame_bytes(newest, categories));
        number = newest.number;
      }
      return PageAnswer{200, "application/octet-stream", bytes};
    }
    if (newest.ended || waited >= kLongestWait) {
      return PageAnswer{newest.ended ? 410 : 204, "text/plain", nullptr};
    }
    return {};
  }

  static constexpr int kUsualPort = 80;
  const CameraState& state;
  const std::vector<std::string>& categories;
  std::string token;
  std::vector<std::string> hosts;  // by which a local page may be called
  std::string url;
  std::shared_ptr<const std::string> page = std::make_shared<const std::string>(embedded::live_html());
  std::shared_ptr<const std::string> refusal =
      std::make_shared<const std::string>("This page needs the address that spincat camera printed.\n");
  std::uint64_t number = 0;  // of the frame in `bytes`
  std::shared_ptr<const std::string> bytes;
};

LiveView::LiveView(const ViewPlace& place, const CameraState& state, const std::vector<std::string>& categories) {
  Listener listener(place.address, place.port);
  pages_ = std::make_unique<Pages>(place.address, listener, state, categories);
  server_.emplace(std::move(listener),
                  [pages = pages_.get()](const HttpRequest& request, std::chrono::milliseconds waited) {
                    return pages->answer(request, waited);
                  });
}

LiveView::~LiveView() = default;

const std::string& LiveView::url() const {
  return pages_->url;
}

}  // namespace spincat::app
