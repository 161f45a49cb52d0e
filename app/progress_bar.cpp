#include "progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include "interrupt.h"
#include "messages.h"
#include "spincat/report/text.h"
#include "spincat/report/text_table.h"
#include "terminal.h"

namespace spincat::app {
namespace {

constexpr std::chrono::milliseconds kQuietStart(1000);  // shorter work is not worth a bar
constexpr std::chrono::milliseconds kBetweenDraws(100);
constexpr std::size_t kBarWidth = 24;

std::string bar_line(std::string_view stage, std::size_t done, std::size_t total, double seconds) {
  const double share = total > 0 ? static_cast<double>(done) / static_cast<double>(total) : 1.0;
  const auto filled = static_cast<std::size_t>(share * kBarWidth);
  const double rate = static_cast<double>(done) / seconds;
  const double left = done > 0 ? static_cast<double>(total - done) / rate : 0.0;
  return fmt::format("{:<20} [{:#<{}}{:.<{}}] {}/{}  {:.3g}/s  {} left", stage, "", filled, "", kBarWidth - filled,
                     done, total, rate, human_seconds(left));
}

}  // namespace

ProgressBar::ProgressBar(const RunOptions& run)
    : enabled_(!run.quiet && isatty(STDERR_FILENO) == 1), width_(terminal_width(STDERR_FILENO, 80)) {}

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
  print_to_stderr("\r\033[K" + cut_in_the_middle(bar_line(stage, done, total, spent.count()), width_ - 1));
}

void ProgressBar::wipe() {
  if (drawn_) {
    print_to_stderr("\r\033[K");
    drawn_ = false;
  }
}

}  // namespace spincat::app
