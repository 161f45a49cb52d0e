// Ctrl-C, SIGTERM and a closed terminal: end cleanly at the next safe place.
#pragma once

namespace spincat::app {

// Thrown where the work may stop.
struct Interrupted {
  int signal = 0;
};

// From now on the first SIGINT, SIGTERM or SIGHUP is only remembered; a second one ends the process at once.
void catch_interrupts();

// Throws Interrupted when a signal has come.
void stop_if_interrupted();

}  // namespace spincat::app
