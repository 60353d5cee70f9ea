#include "trace/skips.h"

#include "base/error.h"

#include <algorithm>

namespace strandlab {
namespace {

constexpr Skip all[] = {
    {"leaf-table", "the table of leaves, 8 bytes each", "where all curves have as many leaves, in order"},
    {"pieces", "fetching and dividing by the number of leaves per curve", "where it is the same everywhere"},
    {"points", "storing points twice where two curves meet", "where all strands have as many curves"},
    {"rows", "fetching the instance's addresses", "where there is one instance of one structure"},
    {"transform", "moving the ray into object space", "where no instance is moved"},
    {"early-out", "everything else of an intersector", "where the ray passes the piece by"},
    {"gentle", "the search for the nearest of several entries", "where a ray crosses a piece gently"},
    {"splitting", "Dekker's splitting in the ray frame", "where fma is fused"},
    {"rounding", "rounding every operation by itself, as C++ does",
     "where the driver fuses and approximates"},
    {reach_skip, "strands that no ray can meet", "where --cull reach allows it"},
    {detail_skip, "strands below a tolerance: a model error", "where --cull detail=LENGTH allows it"},
};

}  // namespace

std::span<const Skip> skips() { return all; }

void check_skips(std::span<const std::string> names) {
    for (const std::string& name : names) {
        if (std::any_of(std::begin(all), std::end(all), [&](const Skip& s) { return s.name == name; }))
            continue;
        std::string known;
        for (const Skip& skip : all) known += (known.empty() ? "" : ", ") + std::string(skip.name);
        fail(ExitCode::usage, "--no-skip {}: there is no such skip; there are {}", name, known);
    }
}

}  // namespace strandlab
