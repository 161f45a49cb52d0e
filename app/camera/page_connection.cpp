#include "app/camera/page_connection.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>
#include <variant>

namespace spincat::app {
namespace {

constexpr std::size_t kMostHead = 8'192;         // bytes of a request
constexpr std::size_t kMostDiscarded = 262'144;  // of a client that goes on after its answer
constexpr std::chrono::seconds kRequestTime(5);  // from the connection, or the answer before, to the request's end
constexpr std::chrono::seconds kAnswerTime(10);  // to take an answer, or to wait for it
constexpr std::chrono::seconds kLeavingTime(1);  // to take the last of it, before the connection is closed
constexpr int kHeadTooLarge = 431;

bool would_wait() {
  return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
}

}  // namespace

short PageConnection::events() const {
  switch (state_) {
    case State::reading:
    case State::leaving:
      return POLLIN;
    case State::writing:
      return POLLOUT;
    case State::waiting:
    case State::gone:
      break;
  }
  return 0;
}

PageConnection::Clock::time_point PageConnection::deadline() const {
  return since_ + (state_ == State::reading ? kRequestTime : state_ == State::leaving ? kLeavingTime : kAnswerTime);
}

void PageConnection::enter(State state, Clock::time_point now) {
  state_ = state;
  since_ = now;
}

void PageConnection::step(short events, Clock::time_point now, const PageHandler& handler) {
  const bool is_ready = events != 0;
  const bool reads = state_ == State::reading || state_ == State::leaving;  // to the end, where he has hung up
  if (now >= deadline() || (events & (POLLERR | POLLNVAL | (reads ? 0 : POLLHUP))) != 0) {
    state_ = State::gone;
  } else if (state_ == State::reading && is_ready) {
    receive(now, handler);
  } else if (state_ == State::waiting) {
    ask(std::chrono::duration_cast<std::chrono::milliseconds>(now - since_), now, handler);
  } else if (state_ == State::writing && is_ready) {
    send_more(now);
  } else if (state_ == State::leaving && is_ready) {
    discard();
  }
}

void PageConnection::finish(const PageHandler& handler) {
  if (state_ == State::waiting) {
    ask(std::chrono::milliseconds::max(), Clock::now(), handler);
  }
}

void PageConnection::receive(Clock::time_point now, const PageHandler& handler) {
  std::array<char, 4'096> bytes;
  const ssize_t count = recv(descriptor(), bytes.data(), std::min(bytes.size(), kMostHead - received_.size()), 0);
  if (count == 0 || (count < 0 && !would_wait())) {
    state_ = State::gone;
  } else if (count > 0) {
    received_.append(bytes.data(), static_cast<std::size_t>(count));
    take_request(now, handler);
  }
}

void PageConnection::take_request(Clock::time_point now, const PageHandler& handler) {
  const std::optional<std::size_t> length = head_length(received_);
  if (!length) {
    if (received_.size() == kMostHead) {
      answer({kHeadTooLarge, "text/plain", nullptr}, false, now);
    }
    return;
  }
  std::variant<HttpRequest, int> parsed = parse_request(std::string_view(received_).substr(0, *length));
  received_.erase(0, *length);
  if (const int* status = std::get_if<int>(&parsed)) {
    answer({*status, "text/plain", nullptr}, false, now);
    return;
  }
  request_ = std::move(std::get<HttpRequest>(parsed));
  enter(State::waiting, now);
  ask(std::chrono::milliseconds(0), now, handler);
}

void PageConnection::ask(std::chrono::milliseconds waited, Clock::time_point now, const PageHandler& handler) {
  if (const std::optional<PageAnswer> given = handler(request_, waited)) {
    answer(*given, request_.stays_open && received_.empty() && given->status < 400, now);
  }
}

void PageConnection::answer(const PageAnswer& answer, bool stays_open, Clock::time_point now) {
  head_ = answer_head(answer.status, answer.type, answer.body ? answer.body->size() : 0, stays_open);
  body_ = answer.body;
  sent_ = 0;
  head_sent_ = false;
  stays_open_ = stays_open;
  enter(State::writing, now);
  send_more(now);
}

// Whether all of it is sent.
bool PageConnection::send_rest_of(const std::string& part, bool is_last) {
  while (sent_ < part.size()) {
    const int flags = MSG_NOSIGNAL | (is_last ? 0 : MSG_MORE);
    const ssize_t count = send(descriptor(), part.data() + sent_, part.size() - sent_, flags);
    if (count < 0) {
      state_ = would_wait() ? state_ : State::gone;
      return false;
    }
    sent_ += static_cast<std::size_t>(count);
  }
  sent_ = 0;
  return true;
}

void PageConnection::send_more(Clock::time_point now) {
  head_sent_ = head_sent_ || send_rest_of(head_, !body_);
  if (!head_sent_ || (body_ && !send_rest_of(*body_, true))) {
    return;
  }
  body_.reset();
  if (stays_open_) {
    enter(State::reading, now);
  } else {
    // Closed at once, with something of his not read, the system would take the answer back.
    shutdown(descriptor(), SHUT_WR);
    enter(State::leaving, now);
  }
}

void PageConnection::discard() {
  std::array<char, 16'384> bytes;
  const ssize_t count = recv(descriptor(), bytes.data(), bytes.size(), 0);
  discarded_ += count > 0 ? static_cast<std::size_t>(count) : 0;
  if (count == 0 || (count < 0 && !would_wait()) || discarded_ > kMostDiscarded) {
    state_ = State::gone;
  }
}

}  // namespace spincat::app
