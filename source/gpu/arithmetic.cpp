#include "gpu/arithmetic.h"

#include "base/random.h"
#include "gpu/compute_pipeline.h"
#include "gpu/embedded_shaders.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace strandlab {
namespace {

constexpr uint32_t hardware_fma_id = 15;  // shaders/shared/portable.h
constexpr uint32_t group_size = 64;

/// Exact in double: a product of two floats has 48 bits.
float residue(float a, float b) {
    const float product = a * b;
    return static_cast<float>(double(a) * double(b) - double(product));
}

std::vector<ArithmeticProbe> product_probes() {
    std::vector<ArithmeticProbe> probes(4096);
    for (size_t i = 0; i < probes.size(); ++i) {
        Random random(17, 0, i);
        ArithmeticProbe& probe = probes[i];
        for (float& x : probe.direction) x = static_cast<float>(random.signed_unit());
        probe.factor = static_cast<float>(random.range(1, 1000));
        probe.minus_product = -(probe.factor * probe.direction[0]);
        probe.middle = {1, 0, 0};
        probe.base = static_cast<float>(random.range(1, 1000));
        probe.minus_square = -(probe.base * probe.base);
    }
    return probes;
}

/// What the answers say; a fact holds only if every single product agrees.
Arithmetic judge(std::span<const ArithmeticProbe> probes, std::span<const ArithmeticAnswer> answers) {
    Arithmetic facts{.fuses_fma = true, .keeps_precise = true, .exact_products = true};
    for (size_t i = 0; i < probes.size(); ++i) {
        facts.keeps_precise = facts.keeps_precise && answers[i].sum == 0;
        facts.contracts = facts.contracts || answers[i].loose_sum != 0;
        facts.rough_quotients =
            facts.rough_quotients || answers[i].quotient != probes[i].factor / probes[i].direction[0];
        facts.rough_roots = facts.rough_roots || answers[i].root != std::sqrt(probes[i].factor);
        for (int axis = 0; axis < 3; ++axis) {
            const float exact = residue(probes[i].factor, probes[i].direction[axis]);
            facts.fuses_fma = facts.fuses_fma && answers[i].fma_residue[axis] == exact;
            facts.exact_products = facts.exact_products && answers[i].dekker_residue[axis] == exact;
        }
    }
    return facts;
}

/// Kept from being computed ahead of time.
float at_run_time(float x) {
    volatile float kept = x;
    return kept;
}

/// Dekker 1971, as in shaders/shared/ray_frame.h.
float dekker_residue(float a, float b, float product) {
    const auto upper_half = [](float x) {
        const float scaled = x * 4097.0f;
        return scaled - (scaled - x);
    };
    const float a_high = upper_half(a), a_low = a - a_high, b_high = upper_half(b), b_low = b - b_high;
    return (((a_high * b_high - product) + a_low * b_high) + a_high * b_low) + a_low * b_low;
}

}  // namespace

std::string Arithmetic::to_string() const {
    return fmt::format("fma is {}; {}precise products are {}contracted, Dekker's splitting is {}{}{}",
                       fuses_fma ? "fused" : "not fused", contracts ? "other products are contracted, " : "",
                       keeps_precise ? "not " : "",
                       exact_products ? "exact" : "NOT exact: expect errors far from the origin",
                       rough_quotients ? ", quotients are rough" : "",
                       rough_roots ? ", roots are rough" : "");
}

std::vector<ArithmeticAnswer> probe_arithmetic(const Device& device, std::span<const ArithmeticProbe> probes,
                                               const ArithmeticProbing& probing) {
    struct PushConstants {
        uint64_t probes, answers;
        uint32_t count, unused;
    };
    const std::span<const uint32_t> plain = embedded_shader("arithmetic.comp");
    const std::vector<uint32_t> alike = probing.rounding.alike
                                            ? rounded_alike(plain, probing.rounding.mends_quotients)
                                            : std::vector<uint32_t>();
    const ComputePipeline pipeline(device, alike.empty() ? plain : alike,
                                   {{hardware_fma_id, probing.hardware_fma ? 1u : 0u}},
                                   sizeof(PushConstants));
    const Buffer input = make_buffer(device, probes, Buffer::Use::storage);
    std::vector<ArithmeticAnswer> answers(probes.size());
    const Buffer output =
        make_buffer(device, std::span<const ArithmeticAnswer>(answers), Buffer::Use::storage);
    const auto count = static_cast<uint32_t>(probes.size());
    const PushConstants constants{input.address(), output.address(), count, 0};
    const ComputePipeline::Dispatch dispatch{std::as_bytes(std::span(&constants, 1)),
                                             (count + group_size - 1) / group_size};
    pipeline.run({&dispatch, 1});
    output.download(std::as_writable_bytes(std::span(answers)));
    return answers;
}

Arithmetic arithmetic_of(const Device& device, const ArithmeticProbing& probing) {
    const std::vector<ArithmeticProbe> probes = product_probes();
    return judge(probes, probe_arithmetic(device, probes, probing));
}

Arithmetic arithmetic_of_cpu() {
    const std::vector<ArithmeticProbe> probes = product_probes();
    std::vector<ArithmeticAnswer> answers(probes.size());
    for (size_t i = 0; i < probes.size(); ++i) {
        const float factor = at_run_time(probes[i].factor);
        for (int axis = 0; axis < 3; ++axis) {
            const float x = at_run_time(probes[i].direction[axis]), product = factor * x;
            answers[i].fma_residue[axis] = std::fma(factor, x, -product);
            answers[i].dekker_residue[axis] = dekker_residue(factor, x, product);
        }
        const float x = at_run_time(probes[i].direction[0]);
        answers[i].sum = factor * x + at_run_time(probes[i].minus_product);
        const float base = at_run_time(probes[i].base);
        answers[i].loose_sum = base * base + at_run_time(probes[i].minus_square);
        answers[i].quotient = factor / x;
        answers[i].root = std::sqrt(factor);
    }
    return judge(probes, answers);
}

}  // namespace strandlab
