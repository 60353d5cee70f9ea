// strandlab render: a picture of a model, and every fact about its primary hits as layers.
#include "base/error.h"
#include "base/log.h"
#include "commands/arguments.h"
#include "commands/command.h"
#include "commands/occluder_shading.h"
#include "commands/ray_arguments.h"
#include "commands/usage_error.h"
#include "measure/memory_budget.h"
#include "report/images.h"
#include "report/shading.h"

#include <memory>

namespace strandlab {
namespace {

struct Options {
    ModelArguments models;
    PrimitiveArguments primitive;
    DeviceArguments device;
    std::string output, resolution = "960x540", camera, occluder;
    uint32_t samples = 4;
    uint64_t seed = 1;
    double bytes_per_curve = 0;
    bool no_shadows = false;
};

/// 1 where a primary hit sees the light: one value per primary ray.
std::vector<float> light_visible(const TracedScene& scene, const Rays& primary, const TraceResult& trace,
                                 const Curves& curves, const glm::dvec3& to_light, const Occluder& occluder) {
    std::vector<float> visible(primary.rays.size(), 1.0f);
    std::vector<size_t> owner;
    Rays rays;
    for (size_t i = 0; i < primary.rays.size(); ++i) {
        const Hit& hit = trace.hits.hits[i];
        if (!hit.is_hit()) continue;
        const glm::vec3 normal = trace.hits.normals[i];
        if (glm::dot(glm::dvec3(normal), to_light) <= 0) {
            visible[i] = 0;
            continue;
        }
        const Ray& ray = primary.rays[i];
        // Away from the strand itself by its own width: a picture forgives what a measurement would not.
        const float width = curves.curves[hit.curve][0].w;
        const Ray shadow_ray{ray.origin + hit.t * ray.direction + 2.0f * width * normal, 0.0f,
                             glm::vec3(to_light), 1e30f};
        if (occluder.meet(shadow_ray)) {
            visible[i] = 0;
            continue;
        }
        rays.rays.push_back(shadow_ray);
        owner.push_back(i);
    }
    set_launch_shape(rays);
    const TraceResult shadow = scene.trace(rays, {.shadow = true, .samples = 1, .warm_up_ms = 0});
    for (size_t i = 0; i < owner.size(); ++i)
        if (shadow.hits.hits[i].is_hit()) visible[owner[i]] = 0;
    return visible;
}

int run(const Options& options) {
    if (options.models.models.size() != 1)
        fail(ExitCode::usage, "render takes one MODEL (a scene file holds several), not {}",
             options.models.models.size());
    check_image_path(options.output);
    const Resolution size = parse_resolution(options.resolution);
    RayArguments ray_arguments;
    ray_arguments.camera = options.camera;
    ray_arguments.check();
    const PrimitiveChoice choice = options.primitive.primitives.empty()
                                       ? parse_primitive("rocaps", options.primitive.caps)
                                       : options.primitive.choices().front();
    Scene scene = load_scene(options.models.models.front(), options.models.curve_options());
    if (!options.occluder.empty()) scene.occluder = load_obj(ByteSource::from_file(options.occluder));
    if (scene.curve_count() == 0)
        fail(ExitCode::bad_input, "{}: there is no curve to render", options.models.models.front());
    const Curves curves = all_curves(scene);
    const Camera camera = camera_of(scene, ray_arguments, size);
    const Rays whole_rays = primary_rays(camera, {size.width, size.height, options.samples}, options.seed);
    const Occluder occluder(scene.occluder);
    Rays rays = whole_rays;
    occluder.cut(rays.rays);
    const TraceDevice device(options.device.options());
    CaseInput input{device, scene, curves, 1, 0, {}};
    input.options.normals = true;
    input.options.traversal = options.device.asked_traversal();
    input.options.ray_extent = object_extent(scene, extent_of(rays));
    const PreparedCase prepared = prepare_case(
        input, options.bytes_per_curve > 0 ? within_memory(input, choice, options.bytes_per_curve) : choice);
    const TraceResult trace = prepared.traced->trace(rays, {});
    ShadingOptions shading;
    shading.width = size.width;
    shading.height = size.height;
    shading.samples = options.samples;
    shading.to_light = light_direction(camera);
    std::vector<float> visible;
    if (!options.no_shadows)
        visible = light_visible(*prepared.traced, rays, trace, curves, shading.to_light, occluder);
    std::vector<glm::vec3> behind;
    if (!scene.occluder.empty())
        behind = occluder_colours(occluder, whole_rays, *prepared.traced, shading, !options.no_shadows);
    device.check_validation();
    write_image(options.output, shade(rays, trace.hits, curves, shading, visible, behind));
    inform("{}: {} x {}, {} samples a pixel, {}, {} leaves, {:.0f} bytes a curve", options.output, size.width,
           size.height, options.samples, choice.label(), prepared.traced->cost().leaf_count,
           double(prepared.resident_bytes()) / double(curves.curves.size()));
    return 0;
}

}  // namespace

Command render_command() {
    return {"render", "a picture of a model, with depth, normal, ids as EXR layers",
            "  strandlab render models/straight.hair -o straight.png\n"
            "  strandlab render hair.hair -o hair.exr --primitive lss:segments=8 --camera "
            "from=1,0.3,-0.5:zoom=3\n" +
                primitive_help(),
            [](CLI::App& app) -> RunCommand {
                auto options = std::make_shared<Options>();
                options->models.add_to(app, true);
                app.add_option("-o,--output", options->output,
                               "picture to write: .png, or .exr with all layers")
                    ->required();
                options->primitive.add_to(app, false);
                options->device.add_to(app);
                app.add_option("--bytes-per-curve", options->bytes_per_curve, bytes_per_curve_help)
                    ->check(CLI::NonNegativeNumber);
                app.add_option("--resolution", options->resolution, "WIDTHxHEIGHT")->capture_default_str();
                app.add_option("--camera", options->camera, "eye=...:target=... or from=x,y,z[:zoom=factor]");
                app.add_option("--samples", options->samples, "rays per pixel")
                    ->capture_default_str()
                    ->check(whole_number(1, 4096));
                app.add_option("--seed", options->seed, "of the places in a pixel")
                    ->capture_default_str()
                    ->check(whole_number(0, ~uint64_t(0)));
                app.add_option("--occluder", options->occluder,
                               "body that hides hair behind it: triangles, .obj (models/head.obj)");
                app.add_flag("--no-shadows", options->no_shadows, "light goes through hair (faster)");
                return [options] { return run(*options); };
            }};
}

}  // namespace strandlab
