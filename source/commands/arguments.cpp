#include "commands/arguments.h"

#include "base/error.h"
#include "base/text.h"
#include "commands/usage_error.h"
#include "primitives/choice_list.h"

#include <algorithm>
#include <cmath>

namespace strandlab {
namespace {

Basis basis_named(const std::string& name) {
    constexpr std::pair<const char*, Basis> names[] = {{"centripetal", Basis::centripetal},
                                                       {"uniform", Basis::uniform},
                                                       {"linear", Basis::linear},
                                                       {"bspline", Basis::bspline}};
    for (const auto& [word, basis] : names)
        if (name == word) return basis;
    fail(ExitCode::usage, "--basis {}: must be centripetal, uniform, linear or bspline", name);
}

}  // namespace

void add_write_options(CLI::App& app, WriteOptions& options) {
    app.add_option("--points-per-curve", options.points_per_curve, ".hair: points that each curve adds")
        ->capture_default_str()
        ->check(whole_number(1, 64));
    app.add_option("--write-strands", options.strands_path, ".npy: file for the strands, int32 [S,2]");
}

void ModelArguments::add_to(CLI::App& app, bool required) {
    CLI::Option* option = app.add_option(
        "MODEL", models,
        "model file (.hair, .tfx, .data, .npy), FILE.hairmesh[,key=value,...], scene (.json) or "
        "generate:NAME,...");
    if (required) option->required();
    app_ = &app;
    app.add_option("--basis", basis, "how points become curves: centripetal, uniform, linear, bspline")
        ->capture_default_str();
    radius_option_ =
        app.add_option("--radius", radius, "radius at the root, scene units; overrides the file's")
            ->capture_default_str();
    radius_tip_option_ =
        app.add_option("--radius-tip", radius_tip, "radius at the tip, scene units")->capture_default_str();
    app.add_option("--unit-scale", unit_scale, "file units to scene units (0.01: centimetres to metres)")
        ->capture_default_str();
}

CurveOptions ModelArguments::curve_options() const {
    CurveOptions options;
    options.basis = basis_named(basis);
    options.root_radius = radius;
    options.tip_radius = radius_tip;
    options.unit_scale = unit_scale;
    options.override_radii = radius_option_->count() > 0 || radius_tip_option_->count() > 0;
    check_options(options);  // before anything is loaded
    return options;
}

std::vector<std::pair<std::string, std::string>> ModelArguments::given() const {
    std::vector<std::pair<std::string, std::string>> all;
    for (const char* name : {"--basis", "--radius", "--radius-tip", "--unit-scale"})
        if (const CLI::Option* option = app_->get_option(name); option->count() > 0)
            all.emplace_back(name, option->results().front());
    return all;
}

void PrimitiveArguments::add_to(CLI::App& app, bool several) {
    CLI::Option* option = app.add_option(
        "--primitive", primitives,
        several ? "NAME[:key=value,...], see below; lists (key=1,2,4) and ranges (key=1..8) make several"
                : "NAME[:key=value,...], see below");
    // Values hold commas and colons: every option takes one.
    option->allow_extra_args(false);
    if (!several) option->expected(1);
    several_ = several;
    app.add_option("--caps", caps,
                   "strand ends: round, open or flat (default: round, or what the primitive can do)");
}

std::vector<PrimitiveChoice> PrimitiveArguments::choices() const {
    std::vector<PrimitiveChoice> all;
    for (const std::string& text : primitives)
        for (PrimitiveChoice& choice : parse_primitives(text, caps)) {
            const bool is_new = std::none_of(all.begin(), all.end(), [&](const PrimitiveChoice& other) {
                return other.label() == choice.label();
            });
            if (is_new) all.push_back(std::move(choice));
        }
    if (!several_ && all.size() > 1)
        fail(ExitCode::usage, "--primitive {}: one primitive, not {}", primitives.front(), all.size());
    if (!primitives.empty()) return all;
    const Caps mode = scene_caps();
    for (const Primitive& primitive : strandlab::primitives()) {
        if (primitive.diagnostic) continue;
        // Nobody asked this primitive in particular: where it cannot do the mode it uses its own.
        const bool can =
            std::find(primitive.caps.begin(), primitive.caps.end(), mode) != primitive.caps.end();
        all.push_back(parse_primitive(primitive.name, can ? name_of(mode) : ""));
    }
    return all;
}

Caps PrimitiveArguments::scene_caps() const {
    if (caps.empty()) return Caps::round;
    const auto mode = caps_named(caps);
    if (!mode) fail(ExitCode::usage, "--caps {}: must be round, open or flat", caps);
    return *mode;
}

void DeviceArguments::add_to(CLI::App& app) {
    app.add_option("--device", device,
                   "part of a device's name, its kind (cpu, discrete...) or number; see strandlab info");
    app.add_flag("--validation", validation, "Vulkan validation layers; a message is an error");
    app.add_option(
           "--traversal", traversal,
           "pipeline (ray tracing), query (ray queries in a compute shader, where the device has them), "
           "auto (the faster one, measured once for each device and shader)")
        ->capture_default_str();
}

DeviceOptions DeviceArguments::options() const {
    return {
        .selector = device, .validation = validation, .ray_query = asked_traversal() != Traversal::pipeline};
}

std::string primitive_help() {
    std::string text = "Primitives and their parameters (--primitive NAME[:key=value,...]):\n";
    for (const Primitive& primitive : primitives()) {
        text += fmt::format("  {:<8} {}\n", primitive.name, primitive.summary);
        std::vector<std::string> caps;
        for (const Caps mode : primitive.caps) caps.emplace_back(name_of(mode));
        text += fmt::format("           caps: {}\n", list_of(caps));
        for (const ParameterInfo& p : primitive.parameters) {
            const std::string range =
                p.choices.empty() ? fmt::format("{:g} to {:g}", p.low, p.high) : list_of(p.choices);
            text += fmt::format("           {}={}: {} ({})\n", p.name, p.default_value, p.help, range);
        }
    }
    return text;
}

Resolution parse_resolution(const std::string& text) {
    const auto parts = split(text, 'x');
    const auto width = parts.size() == 2 ? to_number(parts[0]) : std::nullopt;
    const auto height = parts.size() == 2 ? to_number(parts[1]) : std::nullopt;
    const auto whole = [](const std::optional<double>& n) {
        return n && *n >= 1 && *n <= 32768 && *n == std::floor(*n);
    };
    if (!whole(width) || !whole(height))
        fail(ExitCode::usage, "--resolution {}: must be WIDTHxHEIGHT, each from 1 to 32768", text);
    return {static_cast<uint32_t>(*width), static_cast<uint32_t>(*height)};
}

}  // namespace strandlab
