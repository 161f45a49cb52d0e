#include "app/terminal/interrupt.h"

#include <csignal>
#include <initializer_list>

namespace spincat::app {
namespace {

volatile std::sig_atomic_t caught_signal = 0;

extern "C" void remember_signal(int signal) {
  caught_signal = signal;
}

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = remember_signal;
  action.sa_flags = SA_RESETHAND | SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction inherited {};
    if (sigaction(signal, nullptr, &inherited) == 0 && inherited.sa_handler == SIG_IGN) {
      continue;  // nohup and the like: the caller does not want this signal to end us
    }
    sigaction(signal, &action, nullptr);
  }
}

void stop_if_interrupted() {
  if (caught_signal != 0) {
    throw Interrupted{caught_signal};
  }
}

}  // namespace spincat::app
