// Options for ray sets, and the sets of a scene that they ask for.
#pragma once

#include "commands/arguments.h"
#include "measure/bench_case.h"
#include "trace/camera.h"
#include "trace/ray_sets.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace strandlab {

/// Which rays.
struct RayArguments {
    std::vector<std::string> names;  // ray sets, or .npy files
    std::string resolution;          // empty: by device
    std::string camera;
    uint64_t seed = 1;
    bool shuffle = false;
    size_t error_rays = 10'000;  // of each set; 0: no errors are measured

    void add_to(CLI::App& app, const std::string& default_names);
    /// Throws Error (usage) for a camera or a set that there is not: before work has begun on the others.
    void check() const;
};

/// The camera that frames a scene as the options say.
Camera camera_of(const Scene& scene, const RayArguments& arguments, const Resolution& size);

/// The ray sets of a scene with the common reference's hits at their samples. Secondary and shadow rays
/// spawn once from the reference's primary hits, and are the same for every primitive.
class RaySets {
  public:
    RaySets(const Scene& scene, const Curves& curves, const RayArguments& arguments, const Resolution& size,
            Caps caps);

    const std::vector<MeasuredRays>& sets() const { return sets_; }
    /// Largest coordinate of any origin.
    float extent() const;

  private:
    std::vector<MeasuredRays> sets_;
};

}  // namespace strandlab
