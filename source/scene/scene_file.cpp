// Loading scenes: one model, or a .json file of models and instances.
#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "scene/scene.h"
#include "strands/models.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>

namespace strandlab {
namespace {

using Json = nlohmann::json;

Curves load_and_warn(const std::string& path, const CurveOptions& options, const std::string& strands_path) {
    ImportReport report;
    Curves curves = load_model(path, options, report, strands_path);
    for (const std::string& line : warnings(report, options)) warn("{}: {}", path, line);
    if (curves.curves.empty()) warn("{}: no curve in it: nothing can be hit", path);
    return curves;
}

/// The scene file being read, for messages.
struct SceneReader {
    const std::string& path;

    template <class... Args>
    [[noreturn]] void reject(fmt::format_string<Args...> format, Args&&... args) const {
        fail(ExitCode::bad_input, "{}: {}", path, fmt::format(format, std::forward<Args>(args)...));
    }

    void allow_keys(const Json& object, const std::string& where,
                    std::initializer_list<const char*> keys) const {
        if (!object.is_object()) reject("{} must be an object", where);
        for (const auto& [key, value] : object.items())
            if (std::find(keys.begin(), keys.end(), key) == keys.end())
                reject("{}: unknown key '{}'", where, key);
    }

    float number(const Json& object, const std::string& where, const char* key, float fallback, double low,
                 double high) const {
        if (!object.contains(key)) return fallback;
        const Json& value = object[key];
        if (!value.is_number() || !(value.get<double>() >= low && value.get<double>() <= high))
            reject("{}: {} = {} is not a number from {:g} to {:g}", where, key, text_of(value), low, high);
        return value.get<float>();
    }

    std::string path_in(const Json& object, const std::string& where, const char* key) const {
        if (!object.contains(key)) reject("{}: needs \"{}\", a path", where, key);
        if (!object[key].is_string())
            reject("{}: {} = {} is not a path in quotes", where, key, text_of(object[key]));
        return relative(object[key].get<std::string>());
    }

    /// A value as it may stand in a message: not a whole file.
    static std::string text_of(const Json& value) {
        std::string text = value.dump();
        if (text.size() > 60) text.replace(57, std::string::npos, "...");
        return text;
    }

    Curves model(const Json& entry, const std::string& where, CurveOptions options) const {
        allow_keys(entry, where, {"file", "strands", "radius", "radius_tip", "unit_scale"});
        options.override_radii |= entry.contains("radius") || entry.contains("radius_tip");
        options.root_radius = number(entry, where, "radius", options.root_radius, 0, largest_coordinate);
        options.tip_radius = number(entry, where, "radius_tip", options.tip_radius, 0, largest_coordinate);
        options.unit_scale = number(entry, where, "unit_scale", options.unit_scale, 1e-9, 1e9);
        return load_and_warn(path_in(entry, where, "file"), options,
                             entry.contains("strands") ? path_in(entry, where, "strands") : "");
    }

    std::string relative(const std::string& file) const {
        if (file.rfind("generate:", 0) == 0) return file;
        return (std::filesystem::path(path).parent_path() / file).string();
    }

    SceneInstance instance(const Json& entry, const std::string& where, size_t models) const {
        allow_keys(entry, where, {"model", "transform"});
        SceneInstance instance;
        if (!entry.contains("model") || !entry["model"].is_number_unsigned() ||
            entry["model"].get<uint64_t>() >= models)
            reject("{}: model = {} is not a whole number from 0 to {}", where,
                   entry.contains("model") ? text_of(entry["model"]) : "(missing)", models - 1);
        instance.model = entry["model"].get<uint32_t>();
        if (entry.contains("transform")) instance.world_from_object = transform(entry["transform"], where);
        return instance;
    }

    glm::mat4x3 transform(const Json& numbers, const std::string& where) const {
        if (!numbers.is_array() || numbers.size() != 12)
            reject("{}: transform needs 12 numbers, three rows of four", where);
        glm::mat4x3 matrix;
        for (int i = 0; i < 12; ++i) {
            if (!numbers[i].is_number() || !std::isfinite(numbers[i].get<float>()))
                reject("{}: transform[{}] = {} is not a finite number", where, i, text_of(numbers[i]));
            matrix[i % 4][i / 4] = numbers[i].get<float>();
        }
        const double volume = glm::determinant(glm::dmat3(glm::mat3(matrix)));
        if (!(std::abs(volume) > 0))
            reject("{}: the transform flattens the model (determinant {:g})", where, volume);
        return matrix;
    }
};

/// Deepest nesting of a scene file; messages print values, which recurses.
constexpr int deepest = 16;

Scene load_scene_file(const std::string& path, const CurveOptions& options) {
    const SceneReader reader{path};
    const Json file = [&] {
        const auto stay_shallow = [&](int depth, Json::parse_event_t, const Json&) {
            if (depth > deepest) reader.reject("nested more than {} levels deep", deepest);
            return true;
        };
        try {
            return Json::parse(read_file(path), stay_shallow);
        } catch (const Json::exception& error) {
            reader.reject("not JSON: {}", error.what());
        }
    }();
    reader.allow_keys(file, "the scene", {"models", "instances", "occluder"});
    if (!file.contains("models") || !file["models"].is_array() || file["models"].empty())
        reader.reject("needs \"models\", a list of at least one");
    Scene scene;
    scene.name = std::filesystem::path(path).stem().string();
    for (const Json& entry : file["models"]) {
        const std::string where = fmt::format("models[{}]", scene.models.size());
        scene.models.push_back(reader.model(entry, where, options));
    }
    if (scene.curve_count() >= 0xFFFFFFFFull) reader.reject("{} curves are too many", scene.curve_count());
    if (!file.contains("instances"))
        for (uint32_t i = 0; i < scene.models.size(); ++i) scene.instances.push_back({i});
    else if (!file["instances"].is_array() || file["instances"].empty())
        reader.reject("instances must be a list of at least one; leave it out to place every model once");
    else
        for (const Json& entry : file["instances"]) {
            const std::string where = fmt::format("instances[{}]", scene.instances.size());
            scene.instances.push_back(reader.instance(entry, where, scene.models.size()));
        }
    if (file.contains("occluder"))
        scene.occluder = load_obj(ByteSource::from_file(reader.path_in(file, "the scene", "occluder")));
    return scene;
}

}  // namespace

Scene load_scene(const std::string& path, const CurveOptions& options, const std::string& strands_path) {
    if (std::filesystem::path(path).extension() == ".json") return load_scene_file(path, options);
    return scene_of(model_name(path), load_and_warn(path, options, strands_path));
}

}  // namespace strandlab
