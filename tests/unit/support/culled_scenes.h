// Scenes of moved hair with rays that reach only part of it.
#pragma once

#include "base/random.h"
#include "measure/bench_case.h"
#include "strands/generators.h"

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

namespace strandlab::testing {

/// Two models: one where it is, and turned; the other mirrored, and stretched with a shear.
inline Scene moved_scene() {
    Scene scene = scene_of("moved", generate("generate:fur,strands=400"));
    scene.models.push_back(generate("generate:helix,strands=60,points=9"));
    const float c = std::cos(0.7f), s = std::sin(0.7f);
    scene.instances.push_back({0, {glm::vec3(c, s, 0), {-s, c, 0}, {0, 0, 1}, {0.3f, 0.1f, -0.2f}}});
    scene.instances.push_back({1, {glm::vec3(-1, 0, 0), {0, 1, 0}, {0, 0, 1}, {-0.4f, 0, 0}}});
    scene.instances.push_back({1, {glm::vec3(2, 0, 0), {0.5f, 0.7f, 0}, {0, 0.2f, 1.5f}, {0.1f, -0.3f, 0}}});
    return scene;
}

/// Rays at points in the first `share` of every model along its x axis, some past them: of any length of
/// direction, most ended before, at or soon behind them, a few not at all, some invalid.
inline Rays partial_rays(const Scene& scene, uint32_t count, float share) {
    std::vector<Box> boxes(scene.models.size());
    for (size_t m = 0; m < boxes.size(); ++m)
        for (const Curve& curve : scene.models[m].curves) boxes[m].add(glm::vec3(curve[0]));
    Rays rays;
    rays.name = "partial";
    for (uint32_t i = 0; i < count; ++i) {
        Random random(5, 0, i);
        const SceneInstance& instance =
            scene.instances[random.below(static_cast<uint32_t>(scene.instances.size()))];
        const Curves& model = scene.models[instance.model];
        const Box& box = boxes[instance.model];
        const float size = box.high.x - box.low.x, end = box.low.x + share * size;
        glm::vec4 control(0);
        do control = model.curves[random.below(static_cast<uint32_t>(model.curves.size()))][random.below(4)];
        while (control.x > end);
        glm::dvec3 way(random.signed_unit(), random.signed_unit(), random.signed_unit());
        const glm::dvec3 aside(random.signed_unit(), random.signed_unit(), random.signed_unit());
        const glm::dvec3 target =
            glm::dvec3(instance.world_from_object * glm::vec4(glm::vec3(control), 1.0f)) +
            1.2 * double(control.w) * aside;
        way *= std::pow(10.0, random.range(-3, 3)) / glm::length(way);
        const double distance = 0.1 * double(size) * random.range(0.01, 1) / glm::length(way);
        Ray ray{glm::vec3(target - distance * way), 0.0f, glm::vec3(way),
                static_cast<float>(distance * random.range(0.95, 1.2))};
        if (i % 5 == 2) ray.tmin = static_cast<float>(distance * random.range(0.5, 0.94));
        if (i % 50 == 7) ray.direction[static_cast<int>(i % 3)] = 0;
        if (i % 100 == 11) ray.origin.y = std::nanf("");
        if (i % 100 == 13) ray.tmax = -1;
        if (i % 100 == 17) ray.direction.x = std::numeric_limits<float>::infinity();
        if (i % 500 == 3) ray.tmax = std::numeric_limits<float>::infinity();
        rays.rays.push_back(ray);
    }
    return rays;
}

/// The name of a parameterized test: of the primitive and its parameters.
inline std::string name_of_choice(const ::testing::TestParamInfo<const char*>& parameter) {
    std::string name = parameter.param;
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return name;
}

/// Whether two hits are one place where two pieces of a strand meet: pieces overlap there a little, and of
/// two entries that are equally far the one that a traversal comes upon first counts.
inline bool is_same_joint(const Hit& a, const Hit& b) {
    const double along_a = double(a.curve) + a.u, along_b = double(b.curve) + b.u;
    return a.is_hit() && b.is_hit() && a.t == b.t && a.instance == b.instance &&
           std::abs(along_a - along_b) < 1e-4;
}

/// How many rays have other bits, normals included (but at joints).
inline size_t different_bits(const Hits& a, const Hits& b) {
    size_t count = a.hits.size() == b.hits.size() ? 0 : std::max(a.hits.size(), b.hits.size());
    for (size_t i = 0; i < a.hits.size() && count < a.hits.size(); ++i) {
        const bool same_normal = a.normals.empty() || !a.hits[i].is_hit() ||
                                 std::memcmp(&a.normals[i], &b.normals[i], sizeof a.normals[i]) == 0;
        const bool same = std::memcmp(&a.hits[i], &b.hits[i], sizeof(Hit)) == 0 && same_normal;
        count += same || is_same_joint(a.hits[i], b.hits[i]) ? 0 : 1;
    }
    return count;
}

/// Expects the same bits of all rays with and without what is out of reach, as closest hits and as shadows.
inline void expect_same_answers(const TraceDevice& device, const Scene& scene, const Rays& rays,
                                const PrimitiveChoice& choice) {
    const Curves curves = all_curves(scene);
    CaseInput input{device, scene, curves, 1, 0, {}};
    input.options.normals = true;
    input.options.ray_extent = object_extent(scene, extent_of(rays));
    const PreparedCase whole = prepare_case(input, choice);
    const CulledScene culled = cull(scene, {.reach = true}, rays.rays);
    EXPECT_GT(culled.out_of_reach.strands, 0u) << choice.label() << ": the test leaves nothing out";
    EXPECT_LT(culled.out_of_reach.strands, scene.strand_count()) << choice.label();
    input.culled = &culled;
    const PreparedCase part = prepare_case(input, choice);
    EXPECT_LT(part.traced->cost().leaf_count, whole.traced->cost().leaf_count) << choice.label();
    for (const bool shadow : {false, true}) {
        const std::unique_ptr<TracedRays> buffers = device.upload(rays, true);
        part.traced->run(*buffers, shadow);
        const Hits of_part = buffers->hits();
        whole.traced->run(*buffers, shadow);  // the same buffers: the names of curves are the scene's own
        const Hits of_whole = buffers->hits();
        EXPECT_EQ(different_bits(of_part, of_whole), 0u) << choice.label() << (shadow ? " shadow" : "");
        size_t hits = 0;
        for (const Hit& hit : of_whole.hits) hits += hit.is_hit() ? 1 : 0;
        EXPECT_TRUE(choice.primitive->diagnostic || hits > rays.rays.size() / 10) << choice.label();
    }
}

}  // namespace strandlab::testing
