#include "base/progress.h"

#include "base/log.h"
#include "base/terminal.h"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

namespace strandlab {
namespace {

TEST(Progress, LinesFitTheirWidth) {
    EXPECT_EQ(progress_line("tracing", 0.5, 12, 60),
              "tracing  [===============                ]   50 %  12 s left");
    EXPECT_EQ(progress_line("tracing", 0.999, -1, 30), "tracing  [=========== ]   99 %");
    EXPECT_EQ(progress_line("tracing", 0.25, 75, 34), "tracing   25 %  1 min 15 s left");
    EXPECT_EQ(progress_line("tracing", 1.5, 0, 12), "tracing  100");
    for (int width = 0; width < 100; ++width)
        EXPECT_LE(progress_line("a longer label", 0.3, 4000, width).size(), static_cast<size_t>(width));
}

TEST(Progress, Durations) {
    EXPECT_EQ(duration_text(0), "0 s");
    EXPECT_EQ(duration_text(59.2), "1 min 00 s");
    EXPECT_EQ(duration_text(185), "3 min 05 s");
    EXPECT_EQ(duration_text(7800), "2 h 10 min");
    EXPECT_EQ(duration_text(-1), "?");
    EXPECT_EQ(duration_text(1e300 * 1e10), "?");
}

/// A display whose clock the test sets.
struct Display {
    double now = 100;
    std::vector<std::string> shown;

    Progress::Clock clock() {
        return [this] { return now; };
    }
    Progress::Show show() {
        return [this](std::string_view line) { shown.emplace_back(line); };
    }
};

TEST(Progress, ShowsNothingForTwoSeconds) {
    Display display;
    {
        Progress progress("work", 10, display.clock(), display.show(), 80);
        for (int i = 0; i < 10; ++i) {
            display.now += 0.19;
            progress.tick();
        }
    }
    EXPECT_TRUE(display.shown.empty());
}

TEST(Progress, EstimatesTheTimeLeftAndRemovesTheLine) {
    Display display;
    {
        Progress progress("work", 10, display.clock(), display.show(), 80);
        for (int i = 0; i < 4; ++i) {
            display.now += 1;
            progress.tick();
        }
        ASSERT_EQ(display.shown.size(), 3u);  // after 2, 3 and 4 seconds
        EXPECT_NE(display.shown[2].find("40 %  6 s left"), std::string::npos) << display.shown[2];
        progress.tick();
        EXPECT_EQ(display.shown.size(), 3u) << "not drawn again at once";
    }
    EXPECT_EQ(display.shown.back(), "");
}

TEST(Progress, WithoutDisplayOrClockNothingIsCalled) {
    Progress progress("work", 10, {}, {}, 80);
    progress.tick(10);
}

TEST(Progress, CountsTicksOfManyThreads) {
    Display display;
    Progress progress("work", 4001, display.clock(), display.show(), 80);
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&] {
            for (int i = 0; i < 1000; ++i) progress.tick();
        });
    for (std::thread& thread : threads) thread.join();
    display.now += 3;
    progress.tick();
    // Every thread may have left up to a thousandth of the work between two looks at the clock.
    if (display.shown.empty()) progress.tick(8);
    ASSERT_EQ(display.shown.size(), 1u);
    EXPECT_NE(display.shown[0].find("100 %"), std::string::npos);
}

/// Standard error of a piece of code, which is no terminal here.
template <class Body>
std::string standard_error_of(Body body) {
    testing::internal::CaptureStderr();
    body();
    return testing::internal::GetCapturedStderr();
}

TEST(Progress, IsSilentWhereStandardErrorIsNoTerminal) {
    EXPECT_EQ(standard_error_of([] {
                  Progress progress("work", 3);
                  progress.tick(3);
              }),
              "");
}

TEST(Log, WritesPrefixedLinesAndRespectsQuiet) {
    EXPECT_EQ(standard_error_of([] { inform("{} rays", 3); }), "strandlab: 3 rays\n");
    EXPECT_EQ(standard_error_of([] { warn("{} is slow", "lavapipe"); }),
              "strandlab: warning: lavapipe is slow\n");
    set_quiet(true);
    EXPECT_EQ(standard_error_of([] {
                  inform("3 rays");
                  warn("still said");
              }),
              "strandlab: warning: still said\n");
    set_quiet(false);
}

TEST(Terminal, AFileIsNone) {
    const int file = ::open("/dev/null", O_RDONLY);
    EXPECT_FALSE(is_terminal(file));
    EXPECT_FALSE(may_colour(file));
    EXPECT_EQ(terminal_width(file, 77), 77);
    ::close(file);
}

TEST(Terminal, MessagesAppearAboveTheStatusLine) {
    EXPECT_EQ(standard_error_of([] {
                  show_status("50 %");
                  write_message("note");
                  show_status("");
                  write_message("end");
              }),
              "\r\x1b[K50 %\r\x1b[Knote\n50 %\r\x1b[Kend\n");
}

}  // namespace
}  // namespace strandlab
