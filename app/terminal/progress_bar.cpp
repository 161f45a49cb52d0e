#include "app/terminal/progress_bar.h"

#include <unistd.h>

#include "app/terminal/interrupt.h"
#include "app/terminal/messages.h"
#include "app/terminal/terminal.h"
#include "spincat/report/text.h"

namespace spincat::app {
namespace {

constexpr std::chrono::milliseconds kQuietStart(1000);  // shorter work is not worth a bar
constexpr std::chrono::milliseconds kBetweenDraws(100);

}  // namespace

ProgressBar::ProgressBar(const RunOptions& run) : enabled_(!run.quiet && is_terminal(STDERR_FILENO)) {}

ProgressBar::~ProgressBar() {
  wipe();
}

Progress ProgressBar::callback() {
  return [this](std::string_view stage, std::size_t done, std::size_t total) { update(stage, done, total); };
}

void ProgressBar::update(std::string_view stage, std::size_t done, std::size_t total) {
  stop_if_interrupted();
  const auto now = Clock::now();
  if (stage != stage_) {
    stage_ = stage;
    stage_start_ = now;
  }
  if (!enabled_ || now - stage_start_ < kQuietStart || now - last_draw_ < kBetweenDraws) {
    return;
  }
  last_draw_ = now;
  drawn_ = true;
  const std::chrono::duration<double> spent = now - stage_start_;
  print_to_stderr("\r\033[K" + progress_line(stage, done, total, spent.count(), terminal_width(STDERR_FILENO, 80) - 1));
}

void ProgressBar::wipe() {
  if (drawn_) {
    print_to_stderr("\r\033[K");
    drawn_ = false;
  }
}

}  // namespace spincat::app
