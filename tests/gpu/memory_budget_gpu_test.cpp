// --bytes-per-curve on a device: what stays while tracing is never more, and close to it.
#include "gpu_fixture.h"
#include "measure/memory_budget.h"
#include "strands/generators.h"

namespace strandlab {
namespace {

using MemoryBudgetTest = GpuTest;

TEST_F(MemoryBudgetTest, IsNeverExceededAndUsed) {
    const TraceDevice traced({.selector = device().info().name});
    const Scene scene = scene_of("curly", generate("generate:head,style=curly,strands=300,points=12"));
    const Curves curves = all_curves(scene);
    const CaseInput input{traced, scene, curves, 1, 0, {.ray_extent = 1}};
    for (const char* name : {"prhi", "rocaps"})
        for (const double bytes : {230.0, 300.0, 555.0, 1000.0}) {
            const PreparedCase prepared =
                prepare_case(input, within_memory(input, parse_primitive(name), bytes));
            const double taken = double(prepared.resident_bytes()) / double(curves.curves.size());
            EXPECT_LE(taken, bytes) << name;
            EXPECT_GT(taken, 0.8 * bytes) << name;
        }
    EXPECT_THROW(within_memory(input, parse_primitive("prhi"), 70), Error);
}

}  // namespace
}  // namespace strandlab
