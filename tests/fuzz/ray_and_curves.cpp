#include "fuzz/ray_and_curves.h"

#include "base/random.h"
#include "fuzz/samples.h"
#include "strands/strands.h"

#include <cmath>
#include <limits>

namespace strandlab::fuzz {
namespace {

/// Legal numbers of a curve: what no reader lets through becomes 0.
float legal(float value) { return std::abs(value) <= largest_coordinate ? value : 0.0f; }

class NumberReader {
  public:
    NumberReader(InputReader& reader, Numbers numbers) : reader_(reader), numbers_(numbers) {
        if (numbers == Numbers::scaled) scale_ = std::ldexp(1.0f, int(reader.below(120)) - 90);
    }

    float coordinate() {
        switch (numbers_) {
            case Numbers::bits: return reader_.take<float>();
            case Numbers::grid: return reader_.take<int8_t>() / 16.0f;
            case Numbers::scaled: return reader_.take<int16_t>() / 4096.0f * scale_;
            case Numbers::ordinary: return reader_.take<int16_t>() / 32768.0f;
        }
        return 0;
    }

    float radius() {
        const float value = std::abs(coordinate());
        return numbers_ == Numbers::ordinary ? 0.1f * value * value : value;
    }

    glm::vec3 vector() {
        const float x = coordinate(), y = coordinate();
        return {x, y, coordinate()};
    }

  private:
    InputReader& reader_;
    Numbers numbers_;
    float scale_ = 1;
};

Curve take_curve(NumberReader& numbers) {
    Curve curve;
    for (glm::vec4& point : curve) {
        const glm::vec3 place = numbers.vector();
        point = {legal(place.x), legal(place.y), legal(place.z), legal(numbers.radius())};
    }
    return curve;
}

Curves take_curves(InputReader& reader, NumberReader& numbers) {
    Curves curves;
    const uint32_t count = 1 + reader.below(2);
    for (uint32_t i = 0; i < count; ++i) curves.curves.push_back(take_curve(numbers));
    if (count == 2) curves.curves[1][0] = curves.curves[0][3];
    curves.strands.push_back({0, count});
    return curves;
}

Ray take_ray(InputReader& reader, NumberReader& numbers) {
    Ray ray;
    ray.origin = numbers.vector();
    ray.direction = numbers.vector();
    ray.tmin = numbers.radius();
    ray.tmax = reader.below(4) != 0 ? std::numeric_limits<float>::infinity() : numbers.radius();
    return ray;
}

/// A ray towards a point beside the curve's middle.
Ray take_aimed_ray(InputReader& reader, NumberReader& numbers, const Curve& curve) {
    const glm::vec4 middle = (curve[0] + 3.0f * (curve[1] + curve[2]) + curve[3]) * 0.125f;
    const glm::vec3 target = glm::vec3(middle) + numbers.vector() * (2 * middle.w);
    Ray ray;
    ray.direction = numbers.vector();
    if (!(glm::length(ray.direction) > 1e-3f)) ray.direction = glm::vec3(0, 0, 1);
    ray.origin = target - ray.direction * std::pow(10.0f, float(reader.below(6)));
    ray.tmax = std::numeric_limits<float>::infinity();
    return ray;
}

}  // namespace

RayAndCurves take_ray_and_curves(InputReader& reader) {
    RayAndCurves result;
    result.numbers = static_cast<Numbers>(reader.below(4));
    NumberReader curve_numbers(reader, result.numbers);
    result.curves = take_curves(reader, curve_numbers);
    NumberReader ray_numbers(reader, result.numbers);
    result.ray = result.numbers == Numbers::ordinary
                     ? take_aimed_ray(reader, ray_numbers, result.curves.curves[0])
                     : take_ray(reader, ray_numbers);
    return result;
}

std::vector<std::string> ray_and_curves_seeds() {
    std::vector<std::string> all;
    std::string bits;
    samples::put(bits, uint8_t(Numbers::bits));
    samples::put(bits, uint8_t(0));  // one curve
    for (const float value : {0.f, 0.f, 0.f,  .1f, .3f, .1f,  0.f, .1f, .6f, -.1f, 0.f,   .08f, 1.f,
                              0.f, .1f, .05f, .4f, .1f, -5.f, 0.f, 0.f, 1.f, 0.f,  1e30f, 0.f,  0.f})
        samples::put(bits, value);
    all.push_back(bits);
    for (uint8_t kind = 1; kind < 4; ++kind)
        for (uint32_t count : {0u, 1u}) {
            Random random(11, kind, count);
            std::string bytes;
            samples::put(bytes, kind);
            for (int i = 0; i < 90; ++i) samples::put(bytes, static_cast<uint8_t>(random.bits() >> 8));
            all.push_back(bytes);
        }
    return all;
}

}  // namespace strandlab::fuzz
