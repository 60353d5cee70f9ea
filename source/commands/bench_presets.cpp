#include "commands/bench_presets.h"

#include "base/error.h"
#include "base/log.h"
#include "base/text.h"
#include "commands/bundled_models.h"
#include "report/text_format.h"

#include <algorithm>
#include <filesystem>

namespace strandlab {
namespace {

/// What depends on the device, for CPU devices and for GPUs.
struct Effort {
    uint32_t repeat;
    const char* resolution;
};

struct Preset {
    std::string name, help;
    std::vector<std::string> models, primitives, rays;  // no models: the bundled ones
    size_t error_rays;
    Effort cpu, gpu;
};

/// A hairstyle of the published table: strands x pieces is its number of curves.
struct ArticleStyle {
    uint64_t strands, pieces;
    const char* parameters;
};

constexpr ArticleStyle article_styles[] = {
    {123'299, 96, "style=curly,length=0.25"},
    {25'477, 65, "style=straight,length=0.3,lock_size=1,gathering=0.9"},
};
static_assert(article_styles[0].strands * article_styles[0].pieces == 11'836'704);
static_assert(article_styles[1].strands * article_styles[1].pieces == 1'656'005);

const std::vector<Preset>& presets() {
    static const std::vector<Preset> all{
        {"quick",
         "one model in seconds",
         {"ringlets"},
         {},
         {"primary", "shadow"},
         2000,
         {3, "320x180"},
         {10, "1280x720"}},
        {"default",
         "the bundled models",
         {},
         {},
         {"primary", "diffuse"},
         10'000,
         {15, "640x360"},
         {20, "1920x1080"}},
        {"full",
         "all kinds of rays, all primitives over their parameters",
         {},
         {"null", "dots:segments=1,2,4,8,16", "dots:tolerance=1,0.3,0.1", "lss:segments=1,2,4,8,16,32",
          "lss:tolerance=1,0.3,0.1", "prhi:splits=1,2,4,8", "prhi:variant=published", "rocaps:splits=1,2,4,8",
          "rocaps:variant=published"},
         {"primary", "primary:shuffled", "shadow", "diffuse", "diffuse:shuffled", "ambient", "grazing",
          "interior"},
         20'000,
         {10, "640x360"},
         {30, "1920x1080"}},
        {"article",
         "the published table of curly hair and a ponytail, at its sizes",
         {},
         {"lss:segments=1", "dots:segments=1", "prhi:variant=published", "prhi", "rocaps", "lss"},
         {"primary"},
         20'000,
         {5, "640x360"},
         {30, "1920x1080"}},
        {"scale",
         "cost against size: a head of 10,000 to 12 million curves, as far as the device goes",
         {},
         {"lss", "prhi", "rocaps"},
         {"primary", "interior"},
         0,
         {5, "320x180"},
         {10, "1920x1080"}}};
    return all;
}

const Preset& preset_named(const std::string& name) {
    std::vector<std::string> names;
    for (const Preset& preset : presets()) {
        if (preset.name == name) return preset;
        names.push_back(preset.name);
    }
    fail(ExitCode::usage, "--preset {}: must be {}", name, list_of(names));
}

/// The bundled models, or those of them that the preset names.
std::vector<std::string> models_of(const Preset& preset) {
    std::vector<std::string> all = bundled_models();
    for (std::string& path : all) {  // as the user would write it
        const std::string near =
            std::filesystem::path(path).lexically_proximate(std::filesystem::current_path()).string();
        if (!near.starts_with("..")) path = near;
    }
    if (preset.models.empty()) return all;
    std::erase_if(all, [&](const std::string& path) {
        const std::string name = std::filesystem::path(path).stem().string();
        return std::find(preset.models.begin(), preset.models.end(), name) == preset.models.end();
    });
    if (all.empty())
        fail(ExitCode::bad_input, "--preset {}: {} is not among the bundled models; name a MODEL",
             preset.name, list_of(preset.models));
    return all;
}

/// How many times fewer strands than published a device takes. A curve needs up to 3000 bytes while the
/// largest of the structures is built; a processor traces (and its tree is built for) a hundredth of that in
/// the time.
uint64_t article_divisor(const DeviceInfo& device, uint64_t curves) {
    constexpr uint64_t bytes_per_curve = 3000, most_on_a_processor = 200'000;
    uint64_t most = device.memory == 0 ? most_on_a_processor : device.memory * 9 / 10 / bytes_per_curve;
    if (device.kind == "cpu") most = std::min(most, most_on_a_processor);
    return (curves + most - 1) / std::max<uint64_t>(1, most);
}

std::vector<std::string> article_models(const DeviceInfo& device) {
    std::vector<std::string> models;
    for (const ArticleStyle& style : article_styles) {
        const uint64_t curves = style.strands * style.pieces, divisor = article_divisor(device, curves);
        const uint64_t strands = std::max<uint64_t>(1, style.strands / divisor);
        if (divisor > 1)
            warn("--preset article: {} curves are too many for {}; scaled down to {}", grouped(curves),
                 device.name, grouped(strands * style.pieces));
        models.push_back(fmt::format("generate:head,{},strands={},points={}", style.parameters, strands,
                                     style.pieces + 1));
    }
    return models;
}

/// The same hairstyle with ever more strands.
std::vector<std::string> scale_models(const DeviceInfo& device) {
    constexpr uint64_t pieces = 12, bytes_per_curve = 3000, most_on_a_processor = 1'000'000;
    uint64_t most = device.memory == 0 ? most_on_a_processor : device.memory * 9 / 10 / bytes_per_curve;
    if (device.kind == "cpu") most = std::min(most, most_on_a_processor);
    std::vector<std::string> models;
    for (const uint64_t curves : {10'000, 30'000, 100'000, 300'000, 1'000'000, 3'000'000, 12'000'000})
        if (curves <= most)
            models.push_back(fmt::format("generate:head,style=curly,length=0.2,strands={},points={}",
                                         curves / pieces, pieces + 1));
    return models;
}

}  // namespace

std::string preset_help() {
    std::string text = "what is swept where other options do not say:";
    for (const Preset& preset : presets()) text += fmt::format(" {} ({});", preset.name, preset.help);
    text.pop_back();
    return text;
}

void check_preset(const std::string& name) { preset_named(name); }

void apply_preset(BenchOptions& options, const DeviceInfo& device) {
    const Preset& preset = preset_named(options.preset);
    const Effort& effort = device.kind == "cpu" ? preset.cpu : preset.gpu;
    if (options.models.models.empty())
        options.models.models = preset.name == "article" ? article_models(device)
                                : preset.name == "scale" ? scale_models(device)
                                                         : models_of(preset);
    if (options.primitives.primitives.empty()) options.primitives.primitives = preset.primitives;
    if (options.rays.names.empty()) options.rays.names = preset.rays;
    if (!options.has_error_rays()) options.rays.error_rays = preset.error_rays;
    if (options.rays.resolution.empty()) options.rays.resolution = effort.resolution;
    if (!options.repeat) options.repeat = effort.repeat;
}

double warm_up_of(const DeviceInfo& device) {
    // An idle GPU needs a third of a second of work before it runs at its full clock. Elsewhere the one trace
    // that finds the errors is enough: drivers compile at the first dispatch.
    return device.kind == "cpu" ? 0 : 300;
}

}  // namespace strandlab
