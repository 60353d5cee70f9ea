#include "report/context.h"

#include "base/build_info.h"
#include "base/hash.h"
#include "gpu/embedded_shaders.h"
#include "primitives/primitive.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <ctime>
#include <fstream>
#include <sched.h>
#include <string_view>
#include <sys/utsname.h>
#include <thread>
#include <unistd.h>

namespace strandlab {
namespace {

/// The value after the first line "key<separator>value" of a text file; empty when there is none.
std::string value_in(const char* path, std::string_view key, char separator) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        const size_t at = line.find(separator);
        if (at == std::string::npos || line.substr(0, line.find_last_not_of(" \t", at - 1) + 1) != key)
            continue;
        const size_t first = line.find_first_not_of(" \t\"", at + 1);
        const size_t last = line.find_last_not_of(" \t\"");
        return first == std::string::npos ? "" : line.substr(first, last - first + 1);
    }
    return "";
}

std::string or_unknown(std::string text) { return text.empty() ? "unknown" : text; }

/// Cores that the scheduler lets this process use: fewer than the machine has inside a container.
size_t usable_cores() {
    cpu_set_t set;
    if (::sched_getaffinity(0, sizeof(set), &set) == 0) return static_cast<size_t>(CPU_COUNT(&set));
    return std::thread::hardware_concurrency();
}

std::string system_text() {
    utsname kernel{};
    const std::string name = or_unknown(value_in("/etc/os-release", "PRETTY_NAME", '='));
    if (::uname(&kernel) != 0) return name;
    return fmt::format("{}, {} {}", name, kernel.sysname, kernel.release);
}

std::string utc_now() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    ::gmtime_r(&now, &parts);
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", parts.tm_year + 1900, parts.tm_mon + 1,
                       parts.tm_mday, parts.tm_hour, parts.tm_min, parts.tm_sec);
}

uint64_t hash_of_shaders() {
    Hash sum;
    for (const char* name : {"trace.rgen", "trace.rmiss", "own_curve.rahit"}) sum.add(embedded_shader(name));
    for (const Primitive& primitive : primitives()) {
        const PrimitiveShaders& shaders = primitive.shaders;
        for (const std::string& name : {shaders.intersection, shaders.closest_hit, shaders.any_hit})
            sum.add(embedded_shader(name));
    }
    return sum.value();
}

}  // namespace

Context current_context() {
    const BuildInfo& build = build_info();
    Context context;
    context.version = build.version;
    context.commit = build.commit;
    context.modified = build.modified;
    context.compiler = build.compiler;
    context.flags = build.flags;
    context.build_type = build.build_type;
    context.cpu = or_unknown(value_in("/proc/cpuinfo", "model name", ':'));
    context.cores = usable_cores();
    context.threads = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    const long pages = ::sysconf(_SC_PHYS_PAGES), page_bytes = ::sysconf(_SC_PAGE_SIZE);
    if (pages > 0 && page_bytes > 0)
        context.memory_bytes = static_cast<uint64_t>(pages) * static_cast<uint64_t>(page_bytes);
    context.shaders = hash_of_shaders();
    context.system = system_text();
    context.time = utc_now();
    return context;
}

}  // namespace strandlab
