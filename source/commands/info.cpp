// strandlab info: devices, what they can do, which primitives run there and why not.
#include "base/error.h"
#include "commands/arguments.h"
#include "commands/command.h"
#include "gpu/arithmetic.h"
#include "gpu/device.h"

#include <cstdio>

namespace strandlab {
namespace {

/// Found out by asking the device, which takes opening it.
std::string arithmetic_text(size_t index) {
    try {
        return arithmetic_of(Device({.selector = std::to_string(index)})).to_string();
    } catch (const Error& error) {
        return fmt::format("unknown ({})", error.what());
    }
}

void print_device(size_t index, const DeviceInfo& info) {
    fmt::print("device {}: {} ({})\n", index, info.name, info.kind);
    fmt::print("  driver        {}, Vulkan {}\n", info.driver, info.api_version);
    if (!info.is_usable()) {
        fmt::print("  ray tracing   no: lacks {}\n", info.missing);
        return;
    }
    fmt::print("  ray tracing   {} traversal, pipelines{}\n",
               info.has_ray_tracing_hardware ? "hardware" : "software",
               info.has_ray_query ? " and ray queries" : "");
    fmt::print("  memory        {:.1f} GiB, {:.1f} GiB at once\n", double(info.memory) / double(1 << 30),
               double(info.max_allocation) / double(1 << 30));
    fmt::print("  leaves        {} in one structure; more are spread over several\n", info.max_leaves);
    fmt::print("  timestamps    {:g} ns\n", info.timestamp_period);
    fmt::print("  swept spheres {}\n",
               info.has_linear_swept_spheres
                   ? "VK_NV_ray_tracing_linear_swept_spheres is there; lss still uses its portable shader"
                   : "no VK_NV_ray_tracing_linear_swept_spheres: lss uses its portable shader");
    fmt::print("  arithmetic    {}\n", arithmetic_text(index));
    std::string runs;
    for (const Primitive& primitive : primitives()) runs += (runs.empty() ? "" : ", ") + primitive.name;
    fmt::print("  primitives    {}\n", runs);
}

int run_info() {
    fmt::print("strandlab {}\n\n", version_text());
    std::string none;
    try {
        const std::vector<DeviceInfo> devices = list_devices();
        for (size_t i = 0; i < devices.size(); ++i) print_device(i, devices[i]);
        if (devices.empty()) none = "no Vulkan device; run tools/setup for Mesa's lavapipe";
    } catch (const Error& error) {
        none = error.what();
    }
    if (!none.empty()) fmt::print("device: none ({})\n", none);
    fmt::print("cpu versions of the intersectors: {}\n", arithmetic_of_cpu().to_string());
    fmt::print("\n{}", primitive_help());
    return static_cast<int>(none.empty() ? ExitCode::ok : ExitCode::no_device);
}

}  // namespace

Command info_command() {
    return {"info", "devices, their features, and the primitives that run there", "  strandlab info\n",
            [](CLI::App&) -> RunCommand { return run_info; }};
}

}  // namespace strandlab
