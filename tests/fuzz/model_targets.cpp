#include "fuzz/model_targets.h"

#include "fuzz/load_bytes.h"
#include "fuzz/load_hair_mesh_bytes.h"
#include "fuzz/samples.h"

namespace strandlab::fuzz {
namespace {

constexpr char hair[] = ".hair", tfx[] = ".tfx", data[] = ".data", npy[] = ".npy";

template <const char* extension>
void run(Bytes input) {
    load_bytes(extension, input, static_cast<Basis>(input.size() % 4));
}

/// The strands file that goes with curves: the curves are valid, the strands hostile.
void run_strands(Bytes input) {
    static const std::string curves = samples::npy_curves(4);
    const ByteSource strands = ByteSource::from_memory("input strands", input);
    load_bytes(".npy", samples::as_bytes(curves), Basis::centripetal, &strands);
}

template <const char* extension>
std::vector<std::string> seeds() {
    std::vector<std::string> all;
    for (const samples::Sample& sample : samples::all())
        if (sample.extension == extension) all.push_back(sample.bytes);
    return all;
}

}  // namespace

FuzzTarget hair_target() { return {"hair", run<hair>, seeds<hair>}; }
FuzzTarget hairmesh_target() {
    return {"hairmesh", [](Bytes input) { load_hair_mesh_bytes(input); }, samples::hair_meshes};
}
FuzzTarget tfx_target() { return {"tfx", run<tfx>, seeds<tfx>}; }
FuzzTarget data_target() { return {"data", run<data>, seeds<data>}; }
FuzzTarget npy_target() { return {"npy", run<npy>, seeds<npy>}; }
FuzzTarget npy_strands_target() { return {"npy_strands", run_strands, seeds<npy>}; }

}  // namespace strandlab::fuzz
