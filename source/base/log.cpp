#include "base/log.h"

#include "base/terminal.h"
#include "base/text.h"

#include <atomic>
#include <string>

namespace strandlab {
namespace {

std::atomic<bool> quiet{false};

}  // namespace

void set_quiet(bool value) { quiet.store(value, std::memory_order_relaxed); }

bool is_quiet() { return quiet.load(std::memory_order_relaxed); }

void log_detail::write(std::string_view kind, std::string_view message) {
    write_message(fmt::format("strandlab: {}{}", kind, one_line(message)));
}

}  // namespace strandlab
