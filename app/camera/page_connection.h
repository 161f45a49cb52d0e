// One client of a PageServer: its request, the answer to that, and what of the answer it has taken.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>

#include "app/camera/http_request.h"
#include "app/camera/listener.h"
#include "app/camera/page_server.h"

namespace spincat::app {

class PageConnection {
 public:
  using Clock = std::chrono::steady_clock;
  enum class State { reading, waiting, writing, leaving, gone };

  PageConnection(Descriptor socket, Clock::time_point now) : socket_(std::move(socket)), since_(now) {}

  int descriptor() const { return socket_.get(); }
  State state() const { return state_; }
  Clock::time_point since() const { return since_; }  // it is in this state
  // What poll is to look for.
  short events() const;
  // When it has been given its time.
  Clock::time_point deadline() const;

  // Takes a step where the socket is ready for it (`events` of poll), or time has passed. Never waits.
  void step(short events, Clock::time_point now, const PageHandler& handler);
  // The last step: who waits is answered.
  void finish(const PageHandler& handler);

 private:
  void enter(State state, Clock::time_point now);
  void receive(Clock::time_point now, const PageHandler& handler);
  void take_request(Clock::time_point now, const PageHandler& handler);
  void ask(std::chrono::milliseconds waited, Clock::time_point now, const PageHandler& handler);
  void answer(const PageAnswer& answer, bool stays_open, Clock::time_point now);
  void send_more(Clock::time_point now);
  bool send_rest_of(const std::string& part, bool is_last);
  void discard();

  Descriptor socket_;
  State state_ = State::reading;
  Clock::time_point since_;
  std::string received_;  // 8 kB at most
  HttpRequest request_;
  std::string head_;  // of the answer
  std::shared_ptr<const std::string> body_;
  std::size_t sent_ = 0;  // of the part that is sent now
  bool head_sent_ = false;
  bool stays_open_ = false;
  std::size_t discarded_ = 0;
};

}  // namespace spincat::app
