#include "trace/ray_sets.h"

#include "base/error.h"
#include "base/npy.h"
#include "base/random.h"
#include "strands/bezier.h"
#include "trace/sampling.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

namespace strandlab {
namespace {

const Camera camera{{1, 2, 3}, {0.5, 0, -1}, {0, 1, 0}, 40};

/// Hits on a sphere of radius about the target of the camera: normals and places are known.
struct SphereScene {
    Rays rays;
    std::vector<ReferenceHit> hits;
    glm::dvec3 centre;
    double radius;

    explicit SphereScene(double sphere_radius, PictureSize size = {96, 64, 1}, glm::dvec3 shift = {0, 0, 0})
        : centre(camera.target + shift), radius(sphere_radius) {
        Camera moved = camera;
        moved.eye = centre + glm::normalize(camera.eye - camera.target) * (4 * radius);
        moved.target = centre;
        rays = primary_rays(moved, size);
        for (const Ray& ray : rays.rays) {
            const glm::dvec3 o = glm::dvec3(ray.origin) - centre, d(ray.direction);
            const double a = glm::dot(d, d), b = glm::dot(o, d), c = glm::dot(o, o) - radius * radius;
            ReferenceHit hit;
            if (b * b - a * c > 0) {
                hit.t = (-b - std::sqrt(b * b - a * c)) / a;
                hit.normal = (o + hit.t * d) / radius;
                hit.radius = radius;
                hit.curve = 0;
            }
            hits.push_back(hit);
        }
    }
    PrimaryHits primary() const { return {rays.rays, hits}; }
    size_t hit_count() const {
        return static_cast<size_t>(
            std::count_if(hits.begin(), hits.end(), [](const auto& h) { return h.is_hit(); }));
    }
};

TEST(PrimaryRays, RowsFromTheTopWithUnitDirections) {
    const Rays rays = primary_rays(camera, {30, 20, 1});
    ASSERT_EQ(rays.rays.size(), 600u);
    EXPECT_EQ(rays.width, 30u);
    EXPECT_EQ(rays.height, 20u);
    const CameraFrame frame = frame_of(camera);
    for (const Ray& ray : rays.rays) {
        EXPECT_TRUE(is_valid(ray));
        EXPECT_NEAR(glm::length(glm::dvec3(ray.direction)), 1, 2e-7);
        EXPECT_EQ(ray.origin, glm::vec3(camera.eye));
    }
    const auto across = [&](size_t i) { return glm::dot(glm::dvec3(rays.rays[i].direction), frame.right); };
    const auto up = [&](size_t i) { return glm::dot(glm::dvec3(rays.rays[i].direction), frame.up); };
    EXPECT_LT(across(0), across(29));
    EXPECT_GT(up(0), up(570));
    EXPECT_NEAR(across(0), -across(29), 1e-6);
    EXPECT_NEAR(up(0), -up(599), 1e-6);
    // The pixel edge, half a pixel beyond the centre of the last row, is at half the field of view.
    const double tangent = up(15) / glm::dot(glm::dvec3(rays.rays[15].direction), frame.forward);
    EXPECT_NEAR(tangent, 0.95 * std::tan(20 * 3.14159265358979 / 180), 1e-6);
}

TEST(PrimaryRays, SamplesStayInTheirPixelAndAverageToItsCentre) {
    const PictureSize size{16, 16, 9};
    const Rays many = primary_rays(camera, size, 5), one = primary_rays(camera, {16, 16, 1});
    EXPECT_EQ(many.width, 16u * 9u);
    const CameraFrame frame = frame_of(camera);
    const auto place = [&](const Ray& ray) {
        const glm::dvec3 d(ray.direction);
        return glm::dvec2(glm::dot(d, frame.right), glm::dot(d, frame.up)) / glm::dot(d, frame.forward);
    };
    const double pixel = 2 * std::tan(20 * 3.14159265358979 / 180) / 16;
    glm::dvec2 sum(0);
    for (size_t p = 0; p < one.rays.size(); ++p)
        for (size_t s = 0; s < 9; ++s) {
            const glm::dvec2 offset = place(many.rays[p * 9 + s]) - place(one.rays[p]);
            EXPECT_LE(std::max(std::abs(offset.x), std::abs(offset.y)), 0.5 * pixel + 1e-6);
            sum += offset;
        }
    EXPECT_LT(glm::length(sum / double(many.rays.size())), 0.02 * pixel);
}

TEST(PrimaryRays, PictureMustHoldSomethingAndFit) {
    for (const PictureSize size :
         {PictureSize{0, 10, 1}, PictureSize{10, 10, 0}, PictureSize{1u << 20, 1u << 20, 1}})
        EXPECT_THROW(primary_rays(camera, size), Error);
}

TEST(DiffuseRays, OnePerHitOutsideTheSurface) {
    for (const double radius : {1.0, 1e-3, 2e-5}) {
        const SphereScene scene(radius, {96, 64, 1}, {0, 0, 50 * radius});
        const Rays rays = diffuse_rays(scene.primary(), 3);
        ASSERT_GT(rays.rays.size(), 100u);
        EXPECT_EQ(rays.rays.size(), scene.hit_count());
        EXPECT_GE(size_t(rays.width) * rays.height, rays.rays.size());
        size_t i = 0;
        for (const ReferenceHit& hit : scene.hits) {
            if (!hit.is_hit()) continue;
            const Ray& ray = rays.rays[i++];
            EXPECT_TRUE(is_valid(ray));
            EXPECT_GT(glm::distance(glm::dvec3(ray.origin), scene.centre), radius);
            EXPECT_GT(glm::dot(glm::dvec3(ray.direction), hit.normal), 0);
            EXPECT_NEAR(glm::length(glm::dvec3(ray.direction)), 1, 2e-7);
        }
    }
}

TEST(DiffuseRays, CosineDistributedAboutTheNormal) {
    const SphereScene scene(1.0, {400, 400, 1});
    const Rays rays = diffuse_rays(scene.primary());
    double cosine = 0, square = 0;
    glm::dvec3 across(0);
    size_t i = 0;
    for (const ReferenceHit& hit : scene.hits) {
        if (!hit.is_hit()) continue;
        const glm::dvec3 d(rays.rays[i++].direction);
        const double c = glm::dot(d, hit.normal);
        cosine += c;
        square += c * c;
        across += d - c * hit.normal;
    }
    const double n = double(i);  // E[c] = 2/3, E[c^2] = 1/2
    ASSERT_GT(n, 20000);
    EXPECT_NEAR(cosine / n, 2.0 / 3, 4 * 0.236 / std::sqrt(n));
    EXPECT_NEAR(square / n, 0.5, 4 * 0.289 / std::sqrt(n));
    EXPECT_LT(glm::length(across / n), 5 / std::sqrt(n));
}

TEST(DiffuseRays, HitsWithoutAUsablePlaceHaveNone) {
    SphereScene scene(1.0, {8, 8, 1});
    const size_t before = diffuse_rays(scene.primary()).rays.size();
    size_t changed = 0;
    for (ReferenceHit& hit : scene.hits) {
        if (!hit.is_hit() || changed == 4) continue;
        if (changed == 0) hit.normal = glm::dvec3(0);
        if (changed == 1) hit.normal.x = std::numeric_limits<double>::quiet_NaN();
        if (changed == 2) hit.t = std::numeric_limits<double>::infinity();
        if (changed == 3) hit.starts_inside = true;
        ++changed;
    }
    ASSERT_EQ(changed, 4u);
    EXPECT_EQ(diffuse_rays(scene.primary()).rays.size(), before - 4);
}

TEST(AmbientRays, AreShortAndStartWhereDiffuseOnesDo) {
    const SphereScene scene(1.0);
    const Rays ambient = ambient_rays(scene.primary(), 3), diffuse = diffuse_rays(scene.primary(), 3);
    ASSERT_EQ(ambient.rays.size(), diffuse.rays.size());
    // The box around the half of the sphere that is seen: at most 2 x 2 x 1, and not much less.
    const float reach = ambient.rays.front().tmax;
    EXPECT_GT(reach, 0.2f);
    EXPECT_LT(reach, 0.31f);
    for (size_t i = 0; i < ambient.rays.size(); ++i) {
        EXPECT_EQ(ambient.rays[i].origin, diffuse.rays[i].origin);
        EXPECT_EQ(ambient.rays[i].tmax, reach);
        EXPECT_TRUE(is_valid(ambient.rays[i]));
    }
    EXPECT_NE(ambient.rays.front().direction, diffuse.rays.front().direction);
    EXPECT_TRUE(ambient_rays({}).rays.empty());
}

TEST(ShadowRays, GoToTheLightFromWhatFacesIt) {
    const SphereScene scene(1.0);
    const glm::dvec3 light = world_direction(camera, {-0.5, 0.8, 0.6});
    const Rays rays = shadow_rays(scene.primary(), light);
    EXPECT_GT(rays.rays.size(), 0u);
    EXPECT_LT(rays.rays.size(), scene.hit_count());
    for (const Ray& ray : rays.rays) {
        EXPECT_EQ(ray.direction, glm::vec3(light));
        EXPECT_GT(glm::dot(glm::dvec3(ray.origin) - scene.centre, light), 0);
    }
}

Curves bent_strands() {
    Curves curves;
    for (uint32_t s = 0; s < 5; ++s) {
        const auto x = static_cast<float>(s);
        for (int k = 0; k < 3; ++k) {
            const auto y = static_cast<float>(k);
            curves.curves.push_back({glm::vec4(x, y, 0, 0.01f), glm::vec4(x + 0.2f, y + 0.3f, 0, 0.01f),
                                     glm::vec4(x, y + 0.6f, 0.2f, 0.01f), glm::vec4(x, y + 1, 0, 0.01f)});
        }
        curves.strands.push_back({s * 3, 3});
    }
    return curves;
}

TEST(InteriorRays, StartBesideAStrand) {
    const Curves curves = bent_strands();
    const Rays rays = interior_rays(curves, 500);
    ASSERT_EQ(rays.rays.size(), 500u);
    for (const Ray& ray : rays.rays) {
        EXPECT_TRUE(is_valid(ray));
        double nearest = 1e300;
        for (const Curve& curve : curves.curves)
            for (int k = 0; k <= 400; ++k)
                nearest = std::min(nearest, glm::distance(glm::dvec3(point_at(to_double(curve), k / 400.0)),
                                                          glm::dvec3(ray.origin)));
        // The samples miss the nearest point of the centre line by up to 1.5e-3: 1.2e-4 of distance.
        EXPECT_GT(nearest, 0.0101 - 1e-6);
        EXPECT_LT(nearest, 0.0101 + 1.5e-4);
    }
    EXPECT_THROW(interior_rays(Curves{}, 10), Error);
}

TEST(GrazingRays, PassAStrandAboutItsRadiusAway) {
    const Curves curves = bent_strands();
    const Rays rays = grazing_rays(curves, 500);
    ASSERT_EQ(rays.rays.size(), 500u);
    size_t inner = 0, near = 0;
    for (const Ray& ray : rays.rays) {
        EXPECT_TRUE(is_valid(ray));
        // 20 radii on, the ray is where it grazes.
        const glm::dvec3 at = glm::dvec3(ray.origin) + 0.2 * glm::dvec3(ray.direction);
        double nearest = 1e300;
        for (const Curve& curve : curves.curves)
            for (int k = 0; k <= 400; ++k)
                nearest =
                    std::min(nearest, glm::distance(glm::dvec3(point_at(to_double(curve), k / 400.0)), at));
        EXPECT_LT(nearest, 0.0105 + 2e-4);
        near += nearest > 0.0095 - 1e-6;
        inner += nearest < 0.01;
    }
    EXPECT_GT(near, 480u);  // but where another strand is nearer
    EXPECT_GT(inner, 100u);
    EXPECT_LT(inner, 400u);
    EXPECT_THROW(grazing_rays(Curves{}, 10), Error);
}

TEST(InteriorRays, CurvesThatAreAPointStillGiveRays) {
    Curves curves;
    curves.curves.push_back(
        {glm::vec4(1, 2, 3, 0), glm::vec4(1, 2, 3, 0), glm::vec4(1, 2, 3, 0), glm::vec4(1, 2, 3, 0)});
    curves.strands = {{0, 0}, {0, 1}};
    for (const Ray& ray : interior_rays(curves, 50).rays) EXPECT_TRUE(is_valid(ray));
    for (const Ray& ray : grazing_rays(curves, 50).rays) EXPECT_TRUE(is_valid(ray));
}

TEST(RaySets, TheSameForAnyNumberOfThreads) {
    const Curves curves = bent_strands();
    const SphereScene scene(0.7, {200, 150, 2});
    RaySetInput input{curves, camera, {200, 150, 2}};
    input.seed = 9;
    input.primary = scene.primary();
    for (const RaySetInfo& set : ray_sets()) {
        input.shuffled = false;
        const uint64_t many = hash(make_rays(set, input));
        {
            const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
            EXPECT_EQ(hash(make_rays(set, input)), many) << set.name;
        }
        EXPECT_EQ(make_rays(set, input).name, set.name);
        input.shuffled = true;
        EXPECT_NE(hash(make_rays(set, input)), many) << set.name;
        EXPECT_EQ(make_rays(set, input).name, std::string(set.name) + " shuffled");
        RaySetInput other = input;
        other.seed = 10;
        EXPECT_NE(hash(make_rays(set, other)), hash(make_rays(set, input))) << set.name;
    }
}

TEST(RaySets, ShufflingKeepsEveryRay) {
    Rays rays = primary_rays(camera, {40, 30, 1});
    Rays mixed = rays;
    shuffle(mixed, 4);
    const auto less = [](const Ray& a, const Ray& b) {
        return std::tie(a.direction.x, a.direction.y, a.direction.z) <
               std::tie(b.direction.x, b.direction.y, b.direction.z);
    };
    EXPECT_NE(hash(rays), hash(mixed));
    std::sort(rays.rays.begin(), rays.rays.end(), less);
    std::sort(mixed.rays.begin(), mixed.rays.end(), less);
    EXPECT_EQ(hash(rays), hash(mixed));
}

TEST(RaySets, LaunchShapeHoldsAllRays) {
    for (const size_t count : {size_t(0), size_t(1), size_t(31), size_t(33), size_t(1000), size_t(2073600)}) {
        Rays rays;
        rays.rays.resize(count);
        set_launch_shape(rays);
        EXPECT_GE(size_t(rays.width) * rays.height, count);
        EXPECT_LT(size_t(rays.width) * rays.height, count + rays.width + (count == 0 ? 1 : 0));
    }
}

TEST(RaySets, NamesAreLookedUpWithASuggestion) {
    EXPECT_EQ(ray_set_named("shadow").name, "shadow");
    try {
        ray_set_named("primery");
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::usage);
        EXPECT_NE(std::string(error.what()).find("did you mean 'primary'"), std::string::npos);
    }
}

TEST(RaysFromFloats, InvalidRaysAreDisabledAndCounted) {
    const float nan = std::numeric_limits<float>::quiet_NaN(),
                infinity = std::numeric_limits<float>::infinity();
    const std::vector<float> values = {
        0, 0,   0, 0,  0, 0, 1, infinity,  // valid
        0, 0,   0, 0,  0, 0, 0, 1,         // no direction
        0, 0,   0, -1, 0, 0, 1, 1,         // tmin < 0
        0, 0,   0, 2,  0, 0, 1, 1,         // tmin > tmax
        0, nan, 0, 0,  0, 0, 1, 1,         // not finite
    };
    const LoadedRays loaded = rays_from_floats("some.npy", values);
    EXPECT_EQ(loaded.invalid, 4u);
    ASSERT_EQ(loaded.rays.rays.size(), 5u);
    EXPECT_EQ(loaded.rays.rays[0].tmax, infinity);
    EXPECT_EQ(loaded.rays.rays[0].direction, glm::vec3(0, 0, 1));
    for (const Ray& ray : loaded.rays.rays) EXPECT_TRUE(is_valid(ray));
    EXPECT_THROW(rays_from_floats("x", std::span(values).first(7)), Error);
    EXPECT_THROW(rays_from_floats("x", {}), Error);
}

TEST(LoadRays, ReadsWhatNpyHoldsAndNamesWhatItDoesNot) {
    const std::string path = testing::TempDir() + "strandlab_rays_test.npy";
    Rays rays = primary_rays(camera, {8, 5, 1});
    rays.rays[3].direction = glm::vec3(0);
    write_npy(path, {"<f4", {8}}, std::span<const Ray>(rays.rays));
    const LoadedRays loaded = load_rays(path);
    EXPECT_EQ(loaded.invalid, 1u);
    EXPECT_EQ(loaded.rays.name, path);
    disable_invalid(rays.rays);
    EXPECT_EQ(hash(loaded.rays), hash(rays));

    const float seven[7] = {};
    write_npy(path, {"<f4", {7}}, seven, 1);
    EXPECT_THROW(load_rays(path), Error);
    write_npy(path, {"<f4", {8}}, nullptr, 0);
    EXPECT_THROW(load_rays(path), Error);
    std::remove(path.c_str());
    EXPECT_THROW(load_rays(path), Error);
}

}  // namespace
}  // namespace strandlab
