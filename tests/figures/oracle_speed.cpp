// How long the reference takes for a ray set of a large scene: build and trace with the variations that tell
// which rays are decisive.
//
//     oracle_speed [--threads N] [--rays N] [GENERATOR]
#include "base/stopwatch.h"
#include "primitives/curved_pieces.h"
#include "strands/models.h"
#include "trace/ray_sets.h"
#include "trace/reference.h"

#include <fmt/core.h>
#include <tbb/global_control.h>

#include <cstdlib>
#include <sys/resource.h>

namespace {

using namespace strandlab;

/// Seconds that all threads of this process have computed.
double processor_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

void measure(const Surface& surface, const Curves& curves, const Rays& rays) {
    const double processor = processor_seconds();
    const Stopwatch stopwatch;
    const Reference reference = make_reference(surface, curves, rays.rays);
    const double seconds = stopwatch.milliseconds() / 1000, used = processor_seconds() - processor;
    size_t hits = 0, decisive = 0;
    for (size_t i = 0; i < rays.rays.size(); ++i) {
        hits += reference.hits[i].is_hit();
        decisive += reference.decisive[i];
    }
    fmt::print("{:<10} {:>9} rays  {:>8} hits  {:>9} decisive  {:>7.2f} s  {:>7.2f} processor s\n", rays.name,
               rays.rays.size(), hits, decisive, seconds, used);
}

}  // namespace

int main(int argc, char** argv) {
    size_t threads = 2, count = 1'000'000;
    std::string model = "generate:straight,strands=100000,points=13";
    for (int i = 1; i < argc; ++i) {
        const std::string_view word = argv[i];
        if (word == "--threads" && i + 1 < argc)
            threads = std::strtoul(argv[++i], nullptr, 10);
        else if (word == "--rays" && i + 1 < argc)
            count = std::strtoul(argv[++i], nullptr, 10);
        else
            model = word;
    }
    try {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        ImportReport report;
        const Curves curves = load_model(model, {}, report);
        const Surface surface = curved_surface(curves, Surface::Sweep::sphere, Caps::round);
        fmt::print("{}: {} strands, {} curves; {} threads; times hold the build\n", model,
                   curves.strands.size(), curves.curves.size(), threads);
        const auto width = static_cast<uint32_t>(std::sqrt(double(count)));
        Rays primary = primary_rays(framing(curves, 1.0), {width, width, 1});
        primary.name = "primary";
        measure(surface, curves, primary);
        Rays interior = interior_rays(curves, count);
        interior.name = "interior";
        measure(surface, curves, interior);
    } catch (const std::exception& error) {
        fmt::print(stderr, "oracle_speed: {}\n", error.what());
        return 1;
    }
    return 0;
}
