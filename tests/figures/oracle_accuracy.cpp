// How exact the reference is: against dense search, its own long double version, and Embree where Embree is
// good. Counts are of decisive rays. Exit status 1 where the first two disagree.
//
//     oracle_accuracy [CURVES]     curves of each family, ten rays each; default 400
#include "unit/oracle_comparison.h"

#include <cstdlib>
#include <memory>

namespace {

using namespace strandlab;
using namespace strandlab::oracle_cases;

void print_row(std::string_view against, std::string_view surface, Family family, const Tally& tally) {
    fmt::print("{:<13} {:<13} {:<10} {:>9} {:>9} {:>9} {:>6} {:>8} {:>6} {:>10} {:>11.1e}\n", against,
               surface, name_of(family), tally.rays, tally.hits, tally.decisive, tally.folds, tally.missing,
               tally.extra, tally.elsewhere, tally.worst);
}

struct SweptSurface {
    std::string_view name;
    Surface::Sweep sweep;
    Caps caps;
};
constexpr SweptSurface swept_surfaces[] = {{"spheres round", Surface::Sweep::sphere, Caps::round},
                                           {"spheres open", Surface::Sweep::sphere, Caps::open},
                                           {"discs open", Surface::Sweep::disc, Caps::open}};

size_t compare_with_search(size_t curves, Family family) {
    size_t disagreements = 0;
    for (const SweptSurface& surface : swept_surfaces) {
        const Tally tally = compare_all(family, curves, [&](const Curve& curve) {
            return [&](const Ray& ray) { return against_search(curve, ray, surface.sweep, surface.caps); };
        });
        print_row("dense search", surface.name, family, tally);
        disagreements += tally.missing + tally.extra + tally.elsewhere;
    }
    return disagreements;
}

size_t compare_with_long_double(size_t curves, Family family) {
    size_t disagreements = 0;
    for (const SweptSurface& swept : swept_surfaces) {
        const Tally tally = compare_all(family, curves, [&](const Curve& curve) {
            return [surface = surface_of(curve, swept.sweep, swept.caps)](const Ray& ray) {
                return against_long_double(Oracle(surface), ray);
            };
        });
        print_row("long double", swept.name, family, tally);
        disagreements += tally.missing + tally.extra + tally.elsewhere;
    }
    return disagreements;
}

void compare_with_embree(size_t curves, Family family) {
    const Tally tally = compare_all(
        family, curves,
        [&](const Curve& curve) {
            const auto surface =
                std::make_shared<const Surface>(surface_of(curve, Surface::Sweep::disc, Caps::open));
            const auto embree = std::make_shared<const EmbreeScene>(*surface);
            return [&curve, surface, embree](const Ray& ray) {
                return against_embree(*surface, curves_of(curve), *embree, ray);
            };
        },
        0.05);
    print_row("Embree " + embree_version(), "discs open", family, tally);
}

}  // namespace

int main(int argc, char** argv) {
    const size_t curves = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 400;
    if (curves == 0 || argc > 2) {
        fmt::print(stderr, "usage: oracle_accuracy [CURVES]\n");
        return 2;
    }
    fmt::print("{:<13} {:<13} {:<10} {:>9} {:>9} {:>9} {:>6} {:>8} {:>6} {:>10} {:>11}\n", "against",
               "surface", "family", "rays", "hits", "decisive", "folds", "missing", "extra", "elsewhere",
               "|dt|/r max");
    size_t disagreements = 0;
    for (int f = 0; f < static_cast<int>(Family::count); ++f) {
        const auto family = static_cast<Family>(f);
        disagreements += compare_with_search(curves, family);
        disagreements += compare_with_long_double(10 * curves, family);
        if (embree_available() &&
            (family == Family::gentle || family == Family::curl || family == Family::taper))
            compare_with_embree(10 * curves, family);
    }
    fmt::print(
        "missing: they hit, the reference does not; extra: the other way; elsewhere: |dt| > 1e-3 radii "
        "(Embree: 0.05);\n"
        "folds: hits where the curve stands still, judged by nobody\n");
    return disagreements > 0;
}
