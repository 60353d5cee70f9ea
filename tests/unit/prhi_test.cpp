#include "base/parallel.h"
#include "primitives/primitive.h"
#include "unit/support/disc_reference.h"
#include "unit/support/intersector_errors.h"
#include "unit/support/ray_families.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

namespace strandlab {
namespace {

using testing::DiscAnswer;
using testing::IntersectorErrors;
using testing::RayCurvePair;
using testing::RayFamily;

size_t pairs_per_family() {
    const char* text = std::getenv("STRANDLAB_LONG_TESTS");
    return text == nullptr ? 1000 : std::max(1000, std::atoi(text));
}

struct Answered {
    RayCurvePair pair;
    DiscAnswer answer;
};

std::vector<Answered> answered(const std::vector<RayCurvePair>& pairs) {
    std::vector<Answered> all(pairs.size());
    parallel_for(all.size(), [&](size_t i) {
        all[i] = {pairs[i], testing::disc_answer(to_double(pairs[i].curve), pairs[i].ray)};
    });
    return all;
}

const std::vector<Answered>& family(const std::string& name) {
    static std::map<std::string, std::vector<Answered>> cache;
    std::vector<Answered>& all = cache[name];
    if (all.empty()) {
        std::vector<RayCurvePair> pairs;
        if (name == "structured") pairs = testing::structured_pairs();
        for (size_t i = 0; name != "structured" && i < pairs_per_family(); ++i)
            pairs.push_back(make_pair(testing::ray_family(name), i));
        all = answered(pairs);
    }
    return all;
}

template <class Real>
struct Nearest {
    bool found = false;
    LeafHit<Real> hit;
};

template <class Real>
Nearest<Real> nearest(const PrimitiveChoice& choice, const RayCurvePair& pair) {
    const Curves curves{{pair.curve}, {{0, 1}}};
    const Geometry geometry = choice.primitive->build(curves, choice.options);
    Nearest<Real> best;
    Real tmax = Real(pair.ray.tmax);
    for (size_t leaf = 0; leaf < geometry.leaf_count(); ++leaf) {
        LeafHit<Real> hit;
        bool found;
        if constexpr (std::is_same_v<Real, float>)
            found = choice.primitive->cpu.single(geometry, leaf, pair.ray, tmax, hit);
        else
            found = choice.primitive->cpu.precise(geometry, leaf, pair.ray, tmax, hit);
        if (!found) continue;
        tmax = hit.t;
        best = {true, hit};
    }
    return best;
}

template <class Real>
IntersectorErrors errors_of(const std::string& label, const std::string& name,
                            const std::string& caps = "open") {
    const PrimitiveChoice choice = parse_primitive(label, caps);
    const std::vector<Answered>& all = family(name);
    std::vector<Nearest<Real>> results(all.size());
    parallel_for(all.size(), [&](size_t i) { results[i] = nearest<Real>(choice, all[i].pair); });
    IntersectorErrors errors;
    for (size_t i = 0; i < all.size(); ++i) {
        const auto& [pair, answer] = all[i];
        if (!answer.decisive) continue;
        ++(answer.hit ? errors.hits : errors.misses);
        if (!results[i].found) {
            errors.false_misses += answer.hit.has_value();
            if (answer.hit && std::getenv("DEBUG_MISS")) {
                const CurveD c = to_double(pair.curve);
                fmt::print("MISS {} {} u {:.5f} r {:.4f} r' {:.4f} |C'| {:.5f} e0 {:.4f} e1 {:.4f} e2 {:.4f} chord {:.4f} facing {:.4f} curv {:.4f}\n", name, i, answer.hit->u,
                           answer.hit->radius, derivative_at(c, answer.hit->u).w,
                           glm::length(glm::dvec3(derivative_at(c, answer.hit->u))), glm::length(glm::dvec3(c[1]-c[0])), glm::length(glm::dvec3(c[2]-c[1])), glm::length(glm::dvec3(c[3]-c[2])), glm::length(glm::dvec3(c[3]-c[0])), glm::dot(answer.hit->normal, glm::normalize(glm::dvec3(pair.ray.direction))),
                           glm::length(glm::cross(glm::dvec3(derivative_at(c, answer.hit->u)),glm::dvec3(second_derivative_at(c, answer.hit->u))))/std::pow(glm::length(glm::dvec3(derivative_at(c, answer.hit->u))),3));
            }
        } else if (!answer.hit) {
            ++errors.false_hits;
        } else {
            const glm::dvec3 normal(results[i].hit.normal);
            const double angle = std::atan2(glm::length(glm::cross(normal, answer.hit->normal)),
                                            glm::dot(normal, answer.hit->normal));
            errors.add_hit(results[i].hit.t, answer.hit->t, glm::length(glm::dvec3(pair.ray.direction)),
                           answer.hit->radius, angle);
        }
    }
    return errors;
}

TEST(Prhi, Table) {
    for (const char* label : {"prhi"}) {
        fmt::print("\n{}\n{}", label, IntersectorErrors::header());
        for (const RayFamily& f : testing::ray_families())
            fmt::print("{}", errors_of<float>(label, f.name).row(f.name));
        fmt::print("{}", errors_of<float>(label, "structured").row("structured"));
    }
    fmt::print("\ndouble\n{}", IntersectorErrors::header());
    for (const RayFamily& f : testing::ray_families())
        fmt::print("{}", errors_of<double>("prhi", f.name).row(f.name));
    fmt::print("{}", errors_of<double>("prhi", "structured").row("structured"));
}

}  // namespace
}  // namespace strandlab
