#include "app/camera/page_server.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <exception>
#include <thread>
#include <utility>
#include <vector>

#include "app/camera/camera_state.h"
#include "app/camera/page_connection.h"
#include "spincat/error.h"
#include "spincat/geometry/start_thread.h"

namespace spincat::app {
namespace {

using Clock = PageConnection::Clock;
using State = PageConnection::State;

constexpr std::size_t kMostConnections = 32;
constexpr int kMostAccepted = 256;                       // in a round
constexpr std::chrono::milliseconds kBetweenAsking(20);  // of those who wait for an answer
constexpr std::chrono::milliseconds kBetweenRounds(5);   // however much is asked: the processor is for the frames
constexpr std::chrono::milliseconds kPause(100);         // where there are no descriptors for another connection

}  // namespace

class PageServer::Loop {
 public:
  Loop(Listener listener, PageHandler handler)
      : listener_(std::move(listener)), handler_(std::move(handler)), wake_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    if (!wake_) {
      throw RunError("no descriptor for the live page");
    }
    thread_ = start_thread([this](const std::stop_token& stop) { serve(stop); });
  }

  ~Loop() {
    thread_.request_stop();
    const std::uint64_t one = 1;
    static_cast<void>(!write(wake_.get(), &one, sizeof one));
  }
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

 private:
  void serve(const std::stop_token& stop) {
    lower_priority();
    while (!stop.stop_requested()) {
      try {
        take_round();
        std::this_thread::sleep_for(kBetweenRounds);
      } catch (const std::exception&) {  // no memory: none for clients
        connections_.clear();
      }
    }
    for (PageConnection& connection : connections_) {
      connection.finish(handler_);
    }
  }

  void take_round() {
    std::vector<pollfd> polled = {{wake_.get(), POLLIN, 0}};
    for (const PageConnection& connection : connections_) {
      polled.push_back({connection.descriptor(), connection.events(), 0});
    }
    if (Clock::now() >= accepts_from_) {
      polled.push_back({listener_.descriptor(), POLLIN, 0});
    }
    if (poll(polled.data(), polled.size(), milliseconds_to_wait()) < 0 && errno != EINTR) {
      std::this_thread::sleep_for(kPause);
      return;
    }
    const Clock::time_point now = Clock::now();
    for (std::size_t i = 0; i < connections_.size(); ++i) {
      connections_[i].step(polled[1 + i].revents, now, handler_);
    }
    std::erase_if(connections_, [](const PageConnection& each) { return each.state() == State::gone; });
    if (polled.back().fd == listener_.descriptor() && polled.back().revents != 0) {
      accept_some(now);
    }
  }

  int milliseconds_to_wait() const {
    constexpr std::chrono::milliseconds kLongest(1'000);
    std::chrono::milliseconds wait = Clock::now() < accepts_from_ ? kPause : kLongest;
    const auto now = Clock::now();
    for (const PageConnection& connection : connections_) {
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(connection.deadline() - now);
      wait = std::min(wait, connection.state() == State::waiting ? kBetweenAsking : left);
    }
    return static_cast<int>(std::max(wait, std::chrono::milliseconds(0)).count());
  }

  void accept_some(Clock::time_point now) {
    for (int k = 0; k < kMostAccepted; ++k) {
      Descriptor socket(accept4(listener_.descriptor(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
      if (!socket) {
        if (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM) {
          accepts_from_ = now + kPause;
        }
        return;
      }
      if (connections_.size() == kMostConnections) {
        drop_one();
      }
      connections_.emplace_back(std::move(socket), now);
    }
  }

  // Who has been silent longest goes first, then who has been slowest.
  void drop_one() {
    const auto order = [](const PageConnection& each) {
      return std::pair(each.state() == State::waiting || each.state() == State::writing, each.since());
    };
    connections_.erase(std::ranges::min_element(connections_, {}, order));
  }

  Listener listener_;
  PageHandler handler_;
  Descriptor wake_;
  std::vector<PageConnection> connections_;
  Clock::time_point accepts_from_;
  std::jthread thread_;  // the last member: it uses the others
};

PageServer::PageServer(Listener listener, PageHandler handler)
    : loop_(std::make_unique<Loop>(std::move(listener), std::move(handler))) {}

PageServer::~PageServer() = default;

}  // namespace spincat::app
