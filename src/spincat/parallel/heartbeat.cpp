#include "spincat/parallel/heartbeat.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <string>

#include "spincat/geometry/start_thread.h"
#include "spincat/parallel/farm_messages.h"

namespace spincat {
namespace {

constexpr std::chrono::milliseconds kBetweenBeats(500);

}  // namespace

Heartbeat::Heartbeat(Communicator& ranks)
    : ranks_(ranks), thread_(start_thread([this](const std::stop_token& stop) { beat_on(stop); })) {}

void Heartbeat::beat_on(const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any never;
  std::unique_lock lock(mutex);
  while (!stop.stop_requested()) {
    try {
      beat();
    } catch (const std::exception&) {  // no memory: the next one may have some
    }
    never.wait_for(lock, stop, kBetweenBeats, [] { return false; });
  }
}

// What is still on its way is a sign of life, too; and to a rank that was lost they must not pile up.
void Heartbeat::beat() {
  for (int r = 1; r < ranks_.size(); ++r) {
    if (ranks_.has_sent(r)) {
      ranks_.send(r, farm::kBeat, std::make_shared<const std::string>());
    }
  }
}

}  // namespace spincat
