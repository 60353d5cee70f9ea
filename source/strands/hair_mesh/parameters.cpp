#include "strands/hair_mesh/parameters.h"

#include <algorithm>

namespace strandlab {
namespace {

ParameterInfo amplitude(std::string name, std::string help) {
    return {std::move(name), std::move(help) + ", m", "0", 0, 1};
}

ParameterInfo frequency(std::string name, std::string help, std::string value) {
    return {std::move(name), std::move(help) + ", 1/m", std::move(value), 0, 10000};
}

ParameterInfo share(std::string name, std::string help, std::string value = "0") {
    return {std::move(name), std::move(help), std::move(value), 0, 1};
}

/// Displacement that repeats along the strand in one plane: name, name_frequency, _ramp, _spread, _angle.
void add_oscillation(std::vector<ParameterInfo>& table, const std::string& name, const std::string& what) {
    table.push_back(amplitude(name, "half the width of " + what));
    table.push_back(frequency(name + "_frequency", what + " along the strand", "15"));
    table.push_back({name + "_ramp", "distance from the root at which they are full, m", "0.1", 0, 10});
    table.push_back({name + "_spread", "how far clumps differ in phase, turns", "0.45", 0, 1});
    table.push_back(
        {name + "_angle", "plane of the displacement: angle from u to v, degrees", "0", -360, 360});
}

std::vector<ParameterInfo> make_table() {
    std::vector<ParameterInfo> table{
        {"strands", "number of strands at full detail", "100000", 1, 1e8, true},
        {"points", "curve points of a strand; 0: the exact cubics of the layers, unstyled", "65", 0, 4097,
         true},
        {"seed", "seed of the random numbers", "1", 0, 4294967295.0, true},
        {"lod", "level of detail: share of the strands, which grow thicker for it", "1", 1e-6, 1},
        {"lod_points", "level of detail of the points of a strand; 0: as lod", "0", 0, 1},
        {"lod_window", "part of an octave of lod_points in which strands morph to half the points", "0.5",
         0.001, 1},
        {"root_radius", "radius at the root, m", "35e-6", 0, 1},
        {"tip_radius", "radius at the tip, m", "15e-6", 0, 1},
        {"thickness", "factor of both radii", "1", 0, 1000},
        {"length", "part of the length that is kept", "1", 0.05, 1},
        share("cut", "largest random shortening"),
        share("cut_noise", "largest shortening that neighbours share"),
        frequency("cut_frequency", "of cut_noise across the scalp", "40"),
        share("clump", "how far strands close in on the centre of their clump towards the tip"),
        {"clumps", "clumps in a face", "8", 1, 1024, true},
        {"clump_start", "part of the length where clumping begins", "0.1", -1, 0.99},
        amplitude("curl", "radius of curls"),
        frequency("curl_frequency", "curls along the strand", "30"),
        {"curl_ramp", "distance from the root at which curls are full, m", "0.1", 0, 10},
        share("curl_coherence", "how far strands of a clump share the phase of their curls", "0.5"),
    };
    add_oscillation(table, "wave", "waves");
    add_oscillation(table, "kink", "kinks (straight between sharp bends)");
    table.push_back(amplitude("noise", "displacement that neighbours share"));
    table.push_back(frequency("noise_across", "of noise across the scalp", "40"));
    table.push_back(frequency("noise_along", "of noise along the strand", "10"));
    table.push_back(amplitude("frizz", "displacement of every strand's own"));
    table.push_back(frequency("frizz_frequency", "of frizz along the strand", "60"));
    table.push_back({"ramp", "distance from the root at which noise and frizz are full, m", "0.02", 0, 10});
    table.push_back(amplitude("fuzz", "how far flyaway strands stand off at the tip"));
    table.push_back(share("fuzz_share", "share of the strands that fly away", "0.02"));
    return table;
}

}  // namespace

const std::vector<ParameterInfo>& hair_mesh_parameters() {
    static const std::vector<ParameterInfo> table = make_table();
    return table;
}

bool is_of_caller(const std::string& key) {
    const char* keys[] = {"strands", "seed", "lod", "lod_points", "lod_window"};
    return std::find(std::begin(keys), std::end(keys), key) != std::end(keys);
}

}  // namespace strandlab
