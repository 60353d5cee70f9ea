#include "base/progress.h"

#include "base/log.h"
#include "base/terminal.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <unistd.h>
#include <utility>

namespace strandlab {
namespace {

double steady_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Progress::Show standard_error() {
    if (is_quiet() || !is_terminal(STDERR_FILENO)) return {};
    return show_status;
}

}  // namespace

std::string duration_text(double seconds) {
    if (!(seconds >= 0 && seconds < 1e7)) return "?";
    const auto whole = static_cast<int>(std::ceil(seconds));
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    const int minutes = (whole + 30) / 60;
    return fmt::format("{} h {:02} min", minutes / 60, minutes % 60);
}

std::string progress_line(std::string_view label, double fraction, double seconds_left, int width) {
    constexpr int widest_bar = 40, narrowest_bar = 5;
    fraction = std::clamp(fraction, 0.0, 1.0);
    std::string tail = fmt::format("{:3.0f} %", std::floor(fraction * 100));
    if (seconds_left >= 0) tail += fmt::format("  {} left", duration_text(seconds_left));
    const int room = width - static_cast<int>(label.size() + tail.size()) - 6;  // two gaps and two brackets
    std::string line(label);
    if (room >= narrowest_bar) {
        const int bar = std::min(room, widest_bar);
        const int filled = static_cast<int>(std::floor(fraction * bar));
        line += "  [" + std::string(static_cast<size_t>(filled), '=') +
                std::string(static_cast<size_t>(bar - filled), ' ') + "]";
    }
    line += "  " + tail;
    if (static_cast<int>(line.size()) > width) line.resize(static_cast<size_t>(std::max(width, 0)));
    return line;
}

Progress::Progress(std::string label, uint64_t total)
    : Progress(std::move(label), total, steady_seconds, standard_error(), 0) {}

Progress::Progress(std::string label, uint64_t total, Clock clock, Show show, int width)
    : label_(std::move(label)),
      total_(std::max<uint64_t>(total, 1)),
      clock_(std::move(clock)),
      show_(std::move(show)),
      width_(width),
      start_(show_ ? clock_() : 0),
      next_time_(start_ + delay) {}

Progress::~Progress() {
    if (shown_) show_({});
}

void Progress::look(uint64_t done) {
    // Whoever finds another thread drawing has nothing to do.
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return;
    // The clock is read at most about 1000 times in all, or at every step when there are fewer.
    next_look_.store(done + std::max<uint64_t>(total_ / 1000, 1), std::memory_order_relaxed);
    const double now = clock_();
    if (now < next_time_) return;
    next_time_ = now + interval;
    const double fraction = static_cast<double>(done) / static_cast<double>(total_);
    const double left = fraction > 0 ? (now - start_) * (1 / fraction - 1) : -1;
    // One column stays free: terminals wrap when the last one is written. The width may have changed.
    const int width = width_ > 0 ? width_ : terminal_width(STDERR_FILENO, 80) - 1;
    show_(progress_line(label_, fraction, std::max(left, fraction > 0 ? 0.0 : -1.0), width));
    shown_ = true;
}

}  // namespace strandlab
