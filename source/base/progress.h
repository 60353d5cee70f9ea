// A progress bar with the time that is left, for work that takes longer than two seconds.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>

namespace strandlab {

/// "label  [=====>    ]  45 %  12 s left", at most `width` columns; the bar goes first when it is narrow.
/// fraction in [0, 1]; seconds_left below 0: not known.
std::string progress_line(std::string_view label, double fraction, double seconds_left, int width);

/// "12 s", "3 min 05 s", "2 h 10 min": never more than a minute's worth of false precision.
std::string duration_text(double seconds);

/// Shows how much of `total` steps is done: on standard error, only where that is a terminal and --quiet is
/// off, and only once two seconds have passed. The line disappears with the object.
class Progress {
  public:
    using Clock = std::function<double()>;                    // seconds since any moment
    using Show = std::function<void(std::string_view line)>;  // an empty line removes what is shown

    Progress(std::string label, uint64_t total);
    /// For tests and other displays: an empty show turns it off.
    Progress(std::string label, uint64_t total, Clock clock, Show show, int width);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Marks steps as done. From any thread; one relaxed addition when there is nothing to redraw.
    void tick(uint64_t steps = 1) {
        if (!show_) return;
        const uint64_t done = done_.fetch_add(steps, std::memory_order_relaxed) + steps;
        if (done >= next_look_.load(std::memory_order_relaxed)) look(done);
    }

  private:
    void look(uint64_t done);

    static constexpr double delay = 2, interval = 0.1;  // seconds before the first and between later drawings

    const std::string label_;
    const uint64_t total_;
    const Clock clock_;
    const Show show_;
    const int width_;
    const double start_;
    double next_time_;  // guarded by mutex_
    bool shown_ = false;
    std::mutex mutex_;
    std::atomic<uint64_t> done_{0}, next_look_{0};
};

}  // namespace strandlab
