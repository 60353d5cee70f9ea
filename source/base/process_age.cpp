#include "base/process_age.h"

#include <ctime>
#include <fstream>
#include <sstream>
#include <string>
#include <unistd.h>

namespace strandlab {

double process_age_ms() {
    std::ifstream file("/proc/self/stat");
    std::string text;
    std::getline(file, text);
    // The second field, the program's name in brackets, may hold anything; the start is the 22nd.
    const size_t name_end = text.rfind(')');
    if (name_end == std::string::npos) return 0;
    std::istringstream fields(text.substr(name_end + 1));
    std::string field;
    for (int i = 3; i <= 22; ++i) fields >> field;
    timespec now{};
    if (!fields || clock_gettime(CLOCK_BOOTTIME, &now) != 0) return 0;
    const double ticks = std::stod(field), ticks_per_second = double(sysconf(_SC_CLK_TCK));
    return 1e3 * (double(now.tv_sec) + 1e-9 * double(now.tv_nsec) - ticks / ticks_per_second);
}

}  // namespace strandlab
